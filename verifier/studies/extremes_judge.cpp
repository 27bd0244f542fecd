// SPDX-License-Identifier: MIT
#include "verifier/studies/extremes_judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "scenes/access.h"
#include "scenes/camera.h"
#include "verifier/claims/prediction.h"
#include "verifier/measure/optical_map.h"
#include "verifier/optics/fresnel.h"
#include "verifier/optics/orders.h"

namespace threefold {

namespace {

struct Judged {
    double error = 0, bound = 0; ///< as shares; error infinite: no number, or light on the wrong side
};

/// So many are lost by chance no oftener than once in a thousand pictures.
int forgiven(int pixels, double lost_share) {
    if (!(lost_share > 0)) return 0;
    const double mean = pixels * lost_share;
    double term = std::exp(-mean), more = 1 - term;
    int m = 0;
    while (more > 1e-3 && m < pixels) {
        ++m;
        term *= mean / m;
        more -= term;
    }
    return m;
}

Standing standing_of(const Judged &j, double visible) {
    const bool within = j.error <= j.bound, unseen = j.error <= visible;
    if (within && unseen) return Standing::right;
    return within || unseen ? Standing::degraded : Standing::wrong;
}

void conclude(ExtremeFinding &f, std::vector<Judged> &pixels, double visible, double lost_share) {
    f.judged = static_cast<int>(pixels.size());
    if (pixels.empty()) {
        f.standing = Standing::unresolved;
        return;
    }
    const auto worse = [](const Judged &a, const Judged &b) { return a.error / a.bound > b.error / b.bound; };
    std::ranges::sort(pixels, worse);
    f.forgiven = 0;
    const int most = forgiven(f.judged, lost_share);
    while (f.forgiven < most && standing_of(pixels[static_cast<std::size_t>(f.forgiven)], visible) == Standing::wrong)
        ++f.forgiven;
    f.standing = Standing::right;
    for (std::size_t i = static_cast<std::size_t>(f.forgiven); i < pixels.size(); ++i) {
        const Standing s = standing_of(pixels[i], visible);
        if (s == Standing::wrong) ++f.wrong;
        f.standing = std::max(f.standing, s);
    }
    std::vector<double> errors;
    int without_number = 0;
    for (std::size_t i = static_cast<std::size_t>(f.forgiven); i < pixels.size(); ++i) {
        if (!std::isfinite(pixels[i].error)) {
            ++without_number;
            continue;
        }
        if (errors.empty()) {
            f.bound = pixels[i].bound;
            f.times = pixels[i].error / pixels[i].bound;
        }
        errors.push_back(pixels[i].error);
        f.worst = std::max(f.worst, pixels[i].error);
    }
    if (!errors.empty()) f.median = quantile(errors, 0.5);
    if (without_number > 0)
        f.reason = fmt::format("{} of {} pixels show no light of the card where it is, or light of it where it is not",
                               without_number, f.judged);
}

bool is_number(const Rgb &p) { return std::isfinite(p.r) && std::isfinite(p.g) && std::isfinite(p.b); }

} // namespace

ExtremeFinding judge_landing(const Image &image, const Scene &scene, std::span<const ExactPixel> exact,
                             const Stated &stated) {
    const OrbInScene orb = orb_of(scene);
    const Quad &card = card_of(scene);
    const double radius = orb.optics.outer_mm;
    const Vec2 side_mm(2 * glm::length(card.half_u_mm), 2 * glm::length(card.half_v_mm));
    const Accuracy &a = stated.accuracy;
    constexpr double infinite = std::numeric_limits<double>::infinity();
    ExtremeFinding f;
    std::vector<Judged> pixels;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        const ExactPixel &e = exact[i];
        double bound_mm = 0, place_mm = 0; // of the landing, and of the ray at the orb
        if (stated.rounding > 0) {
            bound_mm = std::max(stated.floor * radius, roundings * stated.rounding * e.condition_mm);
            place_mm = roundings * stated.rounding * e.impact_condition_mm;
        } else {
            const double rounding_mm = 2 * a.rounding_mm;
            bound_mm = rounding_mm * (1 + e.per_shift + e.per_outer + e.per_inner) +
                       a.surface_mm * (e.per_outer + e.per_inner) + a.filter_px * e.per_pixel_mm +
                       2 * a.radiance_step * std::max(side_mm.x, side_mm.y) + double_floor * radius;
            place_mm = rounding_mm + a.surface_mm + a.filter_px * e.impact_per_pixel_mm;
        }
        // Near an edge of the glass light may take either way; near one of the card it may be seen or not.
        bool open = e.to_edge_mm <= place_mm;
        bool seen = false;
        if (e.lands) {
            double inside_mm = infinite; // negative: beside the card
            for (int k = 0; k < 2; ++k) inside_mm = std::min(inside_mm, std::min(e.uv[k], 1 - e.uv[k]) * side_mm[k]);
            open |= std::abs(inside_mm) <= bound_mm;
            seen = inside_mm > 0;
        }
        if (open) {
            ++f.unresolved;
            continue;
        }
        const Rgb &pixel = image.pixels[i];
        const auto uv = is_number(pixel) ? card_coordinates(pixel) : std::nullopt;
        Judged j{0, bound_mm / radius};
        if (!is_number(pixel) || uv.has_value() != seen)
            j.error = infinite;
        else if (seen)
            j.error = glm::length((*uv - e.uv) * side_mm) / radius;
        pixels.push_back(j);
        f.lit += seen;
    }
    conclude(f, pixels, visible_landing, a.lost_paths);
    if (f.standing != Standing::wrong && f.lit < least_lit_share * f.judged) {
        f.standing = Standing::unresolved;
        f.reason = fmt::format("only {} of {} judged pixels show the card", f.lit, f.judged);
    }
    return f;
}

ExtremeFinding judge_light(const Image &image, const Scene &scene, const Stated &stated, int samples_per_pixel) {
    const OrbInScene orb = orb_of(scene);
    const Accuracy &a = stated.accuracy;
    ExtremeFinding f;
    std::vector<Judged> pixels;
    double sum = 0, expected_sum = 0, bound_sum = 0;
    bool numbers = true;
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const Rgb &pixel = image.at(column, row);
            const Ray ray = camera_ray(scene.camera, pixel_sample(scene.camera, column, row));
            const double b = impact_parameter(ray, orb.centre_mm);
            double bound = 0, expected = 1;
            if (stated.rounding > 0) {
                // What a tree may drop in all, and roundings of the sums that it makes at each reflection.
                const optics::Impact<double> impact = optics::impact_at(orb.optics, b);
                const double passed = optics::fresnel_outer(orb.optics, impact).transmittance();
                const double reflections = std::log(a.cut_weight) / std::log1p(-passed);
                bound = a.cut_weight + std::max(stated.floor, roundings * stated.rounding * reflections);
            } else {
                if (a.cut_weight > 0)
                    expected -= optics::missing_weight(orb.optics, optics::impact_at(orb.optics, b), a.cut_weight);
                bound = 2 * a.radiance_step + 2e-6 + 0.2 * (1 - expected) + a.trapped_light;
            }
            numbers &= is_number(pixel);
            sum += pixel.g;
            expected_sum += expected;
            bound_sum += bound;
            if (a.random_branches) continue;
            pixels.push_back(
                {is_number(pixel) ? std::abs(pixel.g - expected) : std::numeric_limits<double>::infinity(), bound});
        }
    f.lit = static_cast<int>(image.pixels.size()); // all of it is light
    if (a.random_branches) {
        // One path a sample, lit or lost: only the mean says something, to three standard deviations.
        const double n = static_cast<double>(image.pixels.size());
        const double loss = std::clamp(1 - sum / n, 0.0, 1.0);
        const double noise = 3 * std::sqrt(std::max(loss, a.lost_paths) / (n * samples_per_pixel));
        pixels.push_back({numbers ? std::abs(sum - expected_sum) / n : std::numeric_limits<double>::infinity(),
                          bound_sum / n + noise + a.lost_paths});
    }
    conclude(f, pixels, visible_light, 0);
    return f;
}

} // namespace threefold
