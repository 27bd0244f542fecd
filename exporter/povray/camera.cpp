// SPDX-License-Identifier: MIT
// The camera as explicit vectors. POV-Ray adds to `direction` (perspective) or `location` (orthographic) a share of
// `right` and `up` from -1/2 to 1/2, at pixel centres. A crop is thus a window off the centre, and a film offset a
// shift.
#include "exporter/povray/writer.h"

#include <cmath>
#include <random>

#include <fmt/format.h>

#include "scenes/camera.h"

namespace threefold::povray {
namespace {

/// The shifts of a grid of `supersampling` samples a pixel that put sample i at (i + u) / supersampling, u uniform in
/// [0, 1), and then at (i + 1 - u) / supersampling: whatever the picture, the mean over u is the mean over the pixel.
/// One shift alone moves the whole picture by up to half a grid step, an error of the first order wherever it has a
/// gradient; in the mirrored pair that cancels. Further pairs follow the first along an even sequence (the R2 sequence,
/// Roberts 2018).
std::vector<Vec2> grid_shifts_px(std::uint64_t seed, const Grid &grid) {
    std::mt19937_64 random(seed);
    const auto uniform = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    const double u = uniform(), v = uniform();
    std::vector<Vec2> shifts;
    for (int pair = 0; pair < grid.pictures / 2; ++pair) {
        const Vec2 at(std::fmod(u + pair * 0.7548776662466927, 1.0), std::fmod(v + pair * 0.5698402909980532, 1.0));
        const Vec2 shift = (at - 0.5) / static_cast<double>(grid.supersampling);
        shifts.push_back(shift);
        shifts.push_back(-shift);
    }
    return shifts;
}

} // namespace

void write_camera(Writer &writer) {
    const Camera &camera = writer.job.scene.camera;
    const CameraFrame frame = camera_frame(camera);
    const double pixel = 2 * film_half_width(camera) / camera.width_px;
    const Vec2 corner_px = camera.crop ? Vec2(camera.crop->x_px, camera.crop->y_px) : Vec2(0);
    const Vec2 size_px(camera.image_width_px(), camera.image_height_px());
    const Vec2 centre_px = corner_px + 0.5 * size_px;
    const auto on_film = [&](Vec2 right_and_down) {
        return right_and_down.x * pixel * frame.right - right_and_down.y * pixel * frame.up;
    };

    // Perspective: at unit distance, which has no unit. Orthographic: in the scene's units.
    const bool perspective = camera.projection == Projection::perspective;
    const double film_unit = perspective ? 1 : writer.space.units_per_mm;
    const Vec3 to_centre = on_film(centre_px - 0.5 * Vec2(camera.width_px, camera.height_px)) * film_unit;

    std::vector<std::string> shifts;
    for (const Replicate &replicate : writer.job.replicates) {
        const Vec2 offset_px = camera.film_offset_px + replicate.film_offset_px;
        const auto add = [&](Vec2 shift_px) { shifts.push_back(vector(on_film(shift_px) * film_unit)); };
        switch (writer.job.sampling) {
        case Sampling::pixel_centres:
            add(offset_px);
            break;
        case Sampling::box:
            for (const Vec2 shift_px : grid_shifts_px(replicate.seed, writer.grid)) add(offset_px + shift_px);
            break;
        }
    }
    // A single frame is no animation to POV-Ray: its frame_number is then 0.
    std::string shift = shifts.front();
    if (shifts.size() > 1) {
        writer.text +=
            fmt::format("#declare film_shift = array[{}] {{\n  {}\n}}\n", shifts.size(), fmt::join(shifts, ",\n  "));
        shift = "film_shift[frame_number - 1]";
    }

    const Vec3 eye = writer.space.point(camera.eye_mm);
    writer.text += fmt::format("camera {{\n  {}\n  location {}\n  right {}\n  up {}\n  direction {}\n}}\n",
                               perspective ? "perspective" : "orthographic",
                               perspective ? vector(eye) : vector(eye + to_centre) + " + " + shift,
                               vector(frame.right * size_px.x * pixel * film_unit),
                               vector(frame.up * size_px.y * pixel * film_unit),
                               perspective ? vector(frame.forward + to_centre) + " + " + shift : vector(frame.forward));
}

} // namespace threefold::povray
