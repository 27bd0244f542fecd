// SPDX-License-Identifier: MIT
#include "exporter/file_reader.h"

#include <fmt/format.h>

#include "exporter/image/texture_file.h"
#include "scenes/error.h"

namespace threefold {

const FileReader &file_reader() {
    static const FileReader reader{
        [](const std::string &path) -> Mesh {
            throw Error(Exit::bad_data, fmt::format("cannot read mesh {}: meshes are not read yet", path));
        },
        read_texture,
    };
    return reader;
}

} // namespace threefold
