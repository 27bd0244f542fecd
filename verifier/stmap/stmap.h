// SPDX-License-Identifier: MIT
// The optical map as compositors take it (an STMap): for each pixel where on a surface its refracted ray lands, by our
// tracer. u to the right, v up, both 0 to 1 over the surface.
#pragma once

#include <string>
#include <vector>

#include "exporter/export/delivery.h"
#include "exporter/image/image.h"

namespace threefold {

/// The object that the map is of: `asked`, or the only one that has texture coordinates. Throws Error(usage) with the
/// names to choose from.
std::string stmap_target(const Scene &scene, const std::string &asked);

/// Red is u, green is v, blue is 1 where the ray lands on the object `target` and 0 elsewhere (then u = v = 0). One ray
/// through each pixel's centre; it goes on refracted where it can, and else is reflected.
Image stmap(const RenderJob &job, const std::string &target);

/// NAME-stmap.exr (32-bit float), NAME-stmap.png (the same in 16 bits) and README.txt.
std::vector<ExportedFile> make_stmap_files(const ExportJob &job, const std::string &target);

} // namespace threefold
