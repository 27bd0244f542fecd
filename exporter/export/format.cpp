// SPDX-License-Identifier: MIT
#include "exporter/export/format.h"

#include <algorithm>
#include <array>

#include "scenes/error.h"
#include "scenes/parameters.h"

namespace threefold {

std::span<const ExportFormatEntry> export_formats() {
    static constexpr std::array table{
        ExportFormatEntry{ExportFormat::blender, "blender", "Blender",
                          "a .blend whose orb's radius, wall and index are in a panel"},
        ExportFormatEntry{ExportFormat::povray, "povray", "POV-Ray", "a scene with its textures, and how to render it"},
        ExportFormatEntry{ExportFormat::glb, "glb", "glTF", "one binary glTF file, for viewers and engines"},
        ExportFormatEntry{ExportFormat::obj, "obj", "OBJ", "Wavefront OBJ with materials, for any modeller"},
        ExportFormatEntry{ExportFormat::mitsuba, "mitsuba", "Mitsuba", "a Mitsuba 3 scene with analytic spheres"},
        ExportFormatEntry{ExportFormat::stmap, "stmap", "STMap",
                          "where on a surface each pixel looks, for compositors: EXR and a 16-bit preview"},
    };
    return table;
}

const ExportFormatEntry &entry_of(ExportFormat format) {
    return *std::ranges::find(export_formats(), format, &ExportFormatEntry::format);
}

ExportFormat parse_export_format(std::string_view name) {
    std::vector<std::string> valid;
    for (const ExportFormatEntry &entry : export_formats()) {
        if (entry.name == name) return entry.format;
        valid.emplace_back(entry.name);
    }
    throw Error(Exit::usage, unknown_name("export format", name, valid));
}

} // namespace threefold
