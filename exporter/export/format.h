// SPDX-License-Identifier: MIT
// What `threefold export --to` makes. A format is added by an entry here and in the table of format.cpp; the compiler
// then names every switch that has to answer for it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace threefold {

enum class ExportFormat { blender, povray, glb, obj, mitsuba, stmap };

struct ExportFormatEntry {
    ExportFormat format;
    std::string_view name;    ///< on the command line: "glb"
    std::string_view title;   ///< for people: "glTF"
    std::string_view summary; ///< what the folder will hold
};

std::span<const ExportFormatEntry> export_formats();
const ExportFormatEntry &entry_of(ExportFormat format);

/// Throws Error(usage) with the valid names and the nearest.
ExportFormat parse_export_format(std::string_view name);

} // namespace threefold
