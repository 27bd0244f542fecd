// SPDX-License-Identifier: MIT
// What was measured and what was expected, drawn over a picture. Coordinates are image pixels; lines keep their width
// on the screen whatever the picture's size.
#pragma once

#include <span>
#include <string>

#include "verifier/agreement/result.h"

namespace threefold::report {

/// An overlay of the picture's size: an <svg> with a title and a description, and its labels as text of the page, which
/// stays the same size when the picture grows. Measured is a solid line and +, expected a dashed line and ×. Marks that
/// are not finite are left out; empty where nothing is left.
std::string marks_overlay(std::span<const Mark> marks, double width_px, double height_px);

/// What the lines mean, for beneath the pictures; only what occurs. Empty without marks.
std::string marks_legend(std::span<const Mark *const> marks);

} // namespace threefold::report
