// SPDX-License-Identifier: MIT
// One libFuzzer target a reader, chosen at compile time: what a stranger's bytes do to the parent process. A refusal
// (Error) is an answer; anything else that is thrown, and whatever a sanitizer sees, is a find.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <unistd.h>

#include "exporter/file_reader.h"
#include "exporter/image/texture_file.h"
#include "exporter/mesh/mesh_file.h"
#include "exporter/mitsuba/read_mitsuba.h"
#include "scenes/catalogue/catalogue.h"
#include "scenes/error.h"
#include "scenes/validate.h"

namespace {

using namespace threefold;

std::string file_with(const std::uint8_t *data, std::size_t size, const char *extension) {
    static const std::string folder = [] {
        std::string name = std::filesystem::temp_directory_path() / "threefold-fuzz-XXXXXX";
        return mkdtemp(name.data()) ? name : std::string(".");
    }();
    const std::string path = folder + "/input" + extension;
    if (std::FILE *file = std::fopen(path.c_str(), "wb")) {
        std::fwrite(data, 1, size, file);
        std::fclose(file);
    }
    return path;
}

/// Lines `name=value` set on the scene that the first byte names.
[[maybe_unused]] void parameters(const std::uint8_t *data, std::size_t size) {
    static const std::vector<SceneRecipe> scenes = built_in_scenes();
    if (size == 0) return;
    const SceneRecipe &recipe = scenes[data[0] % scenes.size()];
    Parameters p(recipe.parameters, Preset::text, no_files());
    const std::string text(reinterpret_cast<const char *>(data + 1), size - 1);
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t end = std::min(text.find('\n', from), text.size());
        const Assignment a = parse_assignment(text.substr(from, end - from));
        // A file, and meshes as fine as can be, are not what is tried here.
        const bool costly = a.name.find("resolution") != std::string::npos || a.name.find("cells") != std::string::npos;
        if (!costly) p.set(a.name, a.value);
        from = end + 1;
    }
    for (const ParameterSpec &s : recipe.parameters)
        if (s.path && !p.word(s.name).empty()) return;
    validate(recipe.make(p));
}

[[maybe_unused]] void mitsuba(const std::uint8_t *data, std::size_t size) {
    const FileReader none{[](const std::string &) -> Mesh { throw Error(Exit::bad_data, "no mesh"); },
                          [](const std::string &, double) -> std::shared_ptr<const Texture> {
                              throw Error(Exit::bad_data, "no picture");
                          }};
    const SceneRecipe recipe = mitsuba_scene(file_with(data, size, ".xml"));
    validate(recipe.make(Parameters(recipe.parameters, Preset::text, none)));
}

[[maybe_unused]] void meshes(const std::uint8_t *data, std::size_t size) {
    static constexpr const char *kinds[] = {".obj", ".ply", ".stl", ".gltf"};
    if (size > 0) (void)read_mesh(file_with(data + 1, size - 1, kinds[data[0] % 4]));
}

[[maybe_unused]] void images(const std::uint8_t *data, std::size_t size) {
    static constexpr const char *kinds[] = {".png", ".exr", ".jpg", ".tif", ".hdr"};
    if (size > 0) (void)read_texture(file_with(data + 1, size - 1, kinds[data[0] % 5]), 0);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
    try {
        THREEFOLD_FUZZ(data, size);
    } catch (const Error &error) {
        if (error.code() == Exit::internal) throw;
    }
    return 0;
}
