// SPDX-License-Identifier: MIT
// A ray between the inner and the outer radius cannot enter the hollow: the totally reflecting rim is as wide as the
// wall. Light is counted by crossings: each lets half through, so that the surroundings appear at 1/16 through the
// hollow (four crossings), at 1/4 by total reflection (two), and at 1 beside the orb.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "verifier/claims/claim.h"
#include "verifier/claims/prediction.h"
#include "verifier/measure/edges.h"

namespace threefold {

namespace {

constexpr double wall_px = 8; ///< the film is so large that the rim is about this wide
constexpr double least_film_px = 160;
constexpr double orb_share = 0.8; ///< of the film's width
constexpr int margin_px = 12;     ///< of the crop beside the rim
constexpr int rows_px = 32;

/// Image x on the horizontal through the crop's middle where the ray has this impact parameter, right of the orb.
double column_of(const Camera &camera, const OrbInScene &orb, double impact_mm) {
    double low = 0, high = camera.image_width_px();
    const auto impact = [&](double x) {
        return impact_parameter(camera_ray(camera, {x, camera.image_height_px() / 2.0}), orb.centre_mm);
    };
    for (int step = 0; step < 60; ++step) {
        const double middle = (low + high) / 2;
        (impact(middle) < impact_mm ? low : high) = middle;
    }
    return low;
}

} // namespace

Claim claim_rim_reads_wall() {
    Claim claim;
    claim.name = "rim-reads-wall";
    claim.statement =
        "Seen against its surroundings, a hollow orb has a totally reflecting rim that is exactly as wide as "
        "its wall, whatever the glass.";
    claim.experiments = [](const ClaimContext &context) {
        Experiment e =
            context.experiment("rim", "the right edge of a hollow orb, magnified", "furnace", {},
                               {assign("orb.kind", "hollow"), assign("glass.coating", "antireflective"),
                                assign("glass.interface_transmittance", "0.5"), assign("environment.radiance", "1"),
                                assign("orb.shift_mm", "0"), assign("image.orb_share", orb_share)});
        const OrbInScene orb = orb_of(e.scene);
        Camera &camera = e.scene.camera;
        const double wall_share = 0.5 * orb_share * orb.optics.wall_mm / orb.optics.outer_mm; // of the film's width
        const double film_px = std::clamp(wall_px / wall_share, least_film_px, 1e8);
        camera.width_px = camera.height_px = static_cast<int>(2 * std::round(film_px / 2));
        const double middle = column_of(camera, orb, orb.optics.outer_mm - orb.optics.wall_mm / 2);
        const int width = 2 * static_cast<int>(std::ceil(film_px * wall_share / 2)) + 2 * margin_px;
        camera.crop = Crop{std::clamp(static_cast<int>(middle) - width / 2, 0, camera.width_px - width),
                           (camera.height_px - rows_px) / 2, width, rows_px};
        // Counting crossings reads the rim only where every ray beside it is totally reflected, and where both borders
        // lie well inside the crop.
        const double left = column_of(camera, orb, orb.optics.inner_mm),
                     right = column_of(camera, orb, orb.optics.outer_mm);
        const bool readable = optics::rim_width(orb.optics) > orb.optics.wall_mm * (1 - 1e-9) && left > 2 &&
                              right < width - 2 && right - left > 2;
        e.sampling = Sampling::box;
        e.samples_per_pixel = 64; // coated glass does not split rays: they are cheap
        e.surface_tolerance_mm = 0.002 * orb.optics.wall_mm;

        const double expected = optics::rim_width(orb.optics);
        e.predict = [orb, expected](const Accuracy &a) {
            return std::vector<Expected>{
                {"width of the rim",
                 "mm",
                 Relation::equal,
                 expected,
                 {{"tessellation", 4 * a.surface_mm, "both borders lie on tessellated spheres"},
                  {"quantisation", 8 * a.radiance_step * orb.optics.wall_mm, "shares of known brightness"},
                  {"arithmetic", 4 * a.rounding_mm, "rounding of positions"},
                  {"edge", 0.002 * orb.optics.wall_mm, "a border that curves through a pixel, and its finite samples"}},
                 true}};
        };
        e.measure = [orb, readable](const Image &image, const Camera &at) {
            if (!readable) return std::vector<Reading>{{"width of the rim", std::numeric_limits<double>::quiet_NaN()}};
            const double split = std::round(column_of(at, orb, orb.optics.outer_mm - orb.optics.wall_mm / 2));
            double sum = 0;
            for (int row = 0; row < image.height; ++row) {
                const Borders b = plateau_borders(image, row, static_cast<int>(split), {1.0 / 16, 1.0 / 4, 1});
                const auto impact = [&](double x) {
                    return impact_parameter(camera_ray(at, {x, row + 0.5}), orb.centre_mm);
                };
                sum += impact(b.right_px) - impact(b.left_px);
            }
            return std::vector<Reading>{{"width of the rim", sum / image.height}};
        };
        return std::vector{e};
    };
    claim.summary = [](const ClaimContext &, Verdict verdict) {
        switch (verdict) {
        case Verdict::holds:
            return "The rim is as wide as the wall in every renderer: who measures the rim in a picture knows the "
                   "glass.";
        case Verdict::fails:
            return "In some renderer the rim is not as wide as the wall.";
        case Verdict::undecided:
            return "It is not settled that the rim is as wide as the wall.";
        }
        return "";
    };
    claim.notes = [](const ClaimContext &context) {
        const OrbInScene orb = orb_of(context.experiment("", "", "furnace", {}, {assign("orb.kind", "hollow")}).scene);
        return std::vector<std::string>{fmt::format(
            "It flips where the wall is so thick that rays pass outside the hollow: inner radius under R/n = {:.4g} mm "
            "(wall over {:.4g} mm at this index).",
            optics::critical_radius(orb.optics), orb.optics.outer_mm - optics::critical_radius(orb.optics))};
    };
    claim.mutant = Fault::wall_doubled;
    return claim;
}

} // namespace threefold
