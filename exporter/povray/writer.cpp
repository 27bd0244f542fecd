// SPDX-License-Identifier: MIT
#include "exporter/povray/writer.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "exporter/recentre.h"
#include "scenes/error.h"

namespace threefold::povray {
namespace {

// POV-Ray 3.7 takes a surface nearer than 1e-4 to where a ray starts for the one it starts on (MIN_ISECT_DEPTH).
constexpr double smallest_gap_in_units = 1e-2;
// Beyond 1e7 it sees nothing (MAX_DISTANCE). Lights stand at three times the extent.
constexpr double usual_extent_in_units = 1e5, greatest_extent_in_units = 1e6;
// It takes the square of half a chord as radius^2 - distance^2 + (distance along the ray)^2. Measured: a sphere
// of 9.8e-6 of the extent is right, one of 1e-6 is not.
constexpr double smallest_sphere = 9.7e-6;

double power_of_ten(int exponent) { return std::stod(fmt::format("1e{}", exponent)); }

} // namespace

void refuse(const std::string &what, const std::string &hint) { throw Error(Exit::bad_data, "POV-Ray: " + what, hint); }

std::string number(double value) {
    if (!std::isfinite(value)) refuse("the scene holds a number that is not finite");
    return fmt::format("{}", value);
}

std::string vector(const glm::dvec3 &v) { return fmt::format("<{},{},{}>", number(v.x), number(v.y), number(v.z)); }

std::string in_quotes(std::string_view text) {
    return nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

Space choose_space(const Scene &scene) {
    const Frame frame = render_frame(scene);
    if (!(frame.extent_mm > 0) || !std::isfinite(frame.extent_mm))
        refuse(fmt::format("the scene's extent of {} mm is not a length", frame.extent_mm));

    int exponent = static_cast<int>(std::floor(std::log10(usual_extent_in_units / frame.extent_mm)));
    if (frame.extent_mm * power_of_ten(exponent) > usual_extent_in_units) --exponent;
    if (frame.smallest_sphere_mm < smallest_sphere * frame.extent_mm)
        refuse(fmt::format(
                   "a glass surface of radius {:.6g} mm is lost in a scene that reaches to {:.6g} mm; it must be at "
                   "least {:.2g} of that",
                   frame.smallest_sphere_mm, frame.extent_mm, smallest_sphere),
               "bring the camera and the background nearer, or use the tracer");
    const auto fits = [&](int e) { return frame.smallest_gap_mm * power_of_ten(e) >= smallest_gap_in_units; };
    if (!fits(exponent) && frame.extent_mm * power_of_ten(exponent + 1) <= greatest_extent_in_units) ++exponent;
    if (!fits(exponent))
        refuse(fmt::format(
                   "the smallest wall or gap of glass, {:.6g} mm, is less than {:.1g} of the scene's extent, {:.6g} mm",
                   frame.smallest_gap_mm, smallest_gap_in_units / greatest_extent_in_units, frame.extent_mm),
               "bring the camera and the background nearer, make the gap wider, or use the tracer");
    const double units_per_mm = power_of_ten(exponent);
    return {frame.origin_mm, units_per_mm, frame.extent_mm * units_per_mm, frame.smallest_sphere_mm};
}

} // namespace threefold::povray
