// SPDX-License-Identifier: MIT
#include "exporter/image/load_pictures.h"

#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "exporter/image/picture_module_version.h"
#include "exporter/text.h"
#include "scenes/error.h"

namespace threefold {
namespace {

namespace fs = std::filesystem;

/// Where the loader found it.
fs::path path_of(const PictureModule *module, const fs::path &place) {
    Dl_info info{};
    return ::dladdr(module, &info) != 0 && info.dli_fname ? fs::path(info.dli_fname) : place;
}

} // namespace

std::vector<fs::path> picture_module_places() {
    const fs::path name = THREEFOLD_PICTURES_FILE;
    std::vector<fs::path> places;
    std::error_code error;
    if (const fs::path program = fs::read_symlink("/proc/self/exe", error); !error) {
        places.push_back(program.parent_path() / name);
        places.push_back((program.parent_path() / THREEFOLD_PICTURES_FROM_PROGRAM / name).lexically_normal());
    }
    places.push_back(name); // DT_RUNPATH of the program, LD_LIBRARY_PATH, the system's folders
    places.push_back(fs::path(THREEFOLD_PICTURES_INSTALLED) / name);
    return places;
}

LoadedPictures load_pictures(const std::vector<fs::path> &places) {
    std::vector<std::string> tried;
    for (const fs::path &place : places) {
        std::error_code ignored;
        if (place.has_parent_path() && !fs::exists(place, ignored)) {
            tried.push_back(fmt::format("{}: no such file", place.string()));
            continue;
        }
        // Lazily: most of the functions in all those libraries are never called.
        void *const handle = ::dlopen(place.c_str(), RTLD_LAZY | RTLD_LOCAL);
        if (!handle) {
            const std::string why = reason(::dlerror());
            tried.push_back(why.starts_with(place.string()) ? why : fmt::format("{}: {}", place.string(), why));
            continue;
        }
        const auto *module = static_cast<const PictureModule *>(::dlsym(handle, "threefold_pictures"));
        if (module && std::string_view(module->version) == picture_module_version)
            return {module, path_of(module, place)};
        tried.push_back(module
                            ? fmt::format("{}: it is of {}", path_of(module, place).string(), one_line(module->version))
                            : fmt::format("{}: it is no module of Threefold", place.string()));
        ::dlclose(handle);
    }
    throw Error(Exit::input_output,
                fmt::format("the module for picture files ({}) cannot be loaded: {}", picture_module_version,
                            fmt::join(tried, "; ")),
                "install Threefold anew; the module belongs to it");
}

const LoadedPictures &loaded_pictures() {
    static const LoadedPictures loaded = load_pictures(picture_module_places());
    return loaded;
}

} // namespace threefold
