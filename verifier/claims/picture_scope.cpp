// SPDX-License-Identifier: MIT
#include "verifier/claims/picture_scope.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "scenes/access.h"
#include "scenes/light.h"
#include "verifier/agreement/tiles.h"
#include "verifier/claims/scope_bounds.h"
#include "verifier/claims/visible.h"
#include "verifier/measure/mesh_rays.h"
#include "verifier/measure/tile_grid.h"

namespace threefold {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The picture as the bounds see it.
struct View {
    Scene scene;
    OrbInScene orb;
    int tile_px;
    double needed_share;
    std::vector<SeenPoint> seen;
    double brightest = 0; ///< of what is seen: taken for the brightest thing that the orb can show

    TileGrid grid() const { return {scene.camera.image_width_px(), scene.camera.image_height_px(), tile_px}; }
    int columns() const { return grid().columns; }
    int rows() const { return grid().rows; }
    std::size_t tile_of(int column, int row) const {
        return static_cast<std::size_t>(std::min(row / tile_px, rows() - 1)) * static_cast<std::size_t>(columns()) +
               static_cast<std::size_t>(std::min(column / tile_px, columns() - 1));
    }
    const SeenPoint &at(int column, int row) const {
        return seen[static_cast<std::size_t>(row) * static_cast<std::size_t>(scene.camera.image_width_px()) +
                    static_cast<std::size_t>(column)];
    }
    /// Tiles that may differ.
    std::size_t spare() const { return static_cast<std::size_t>(tiles_allowed(columns() * rows(), needed_share)); }
};

View view_of(const Experiment &e) {
    View v{e.scene, orb_of(e.scene), e.tile_px, e.tiles_needed_share, first_seen(e.scene)};
    for (const SeenPoint &p : v.seen) v.brightest = std::max(v.brightest, p.radiance);
    return v;
}

/// The greatest tile mean but for the spare ones.
double worst_tile(const View &v, const std::function<double(int column, int row)> &change) {
    const std::size_t count = static_cast<std::size_t>(v.columns()) * static_cast<std::size_t>(v.rows());
    std::vector<double> sums(count, 0.0), pixels(count, 0.0);
    for (int row = 0; row < v.scene.camera.image_height_px(); ++row)
        for (int column = 0; column < v.scene.camera.image_width_px(); ++column) {
            sums[v.tile_of(column, row)] += change(column, row);
            pixels[v.tile_of(column, row)] += 1;
        }
    for (std::size_t k = 0; k < count; ++k) sums[k] /= pixels[k];
    std::ranges::sort(sums, std::greater<>());
    return sums[std::min(v.spare(), count - 1)];
}

double impact_at(const View &v, int column, int row) {
    return impact_parameter(camera_ray(v.scene.camera, Vec2(column + 0.5, row + 0.5)), v.orb.centre_mm);
}

/// By impact parameter, on a grid: a picture has thousands of pixels of the orb, and each would follow all orders.
class ByImpact {
public:
    ByImpact(const OrbInScene &orb, const std::function<double(double impact_mm)> &f) : radius_(orb.optics.outer_mm) {
        for (int k = 0; k < steps; ++k) values_.push_back(f(radius_ * (k + 0.5) / steps));
    }
    double operator()(double impact_mm) const {
        if (!(impact_mm < radius_)) return 0;
        return values_[static_cast<std::size_t>(impact_mm / radius_ * steps)];
    }

private:
    static constexpr int steps = 200;
    double radius_;
    std::vector<double> values_;
};

std::vector<optics::Order> orders_at(const OrbInScene &orb, double impact_mm, optics::Polarisation polarisation) {
    return optics::transmitted_orders(orb.optics, optics::impact_at(orb.optics, impact_mm), 1e-6, polarisation,
                                      orb.glass.interface_transmittance, 100'000)
        .orders;
}

/// Each order shows something no brighter than the brightest: what it gains or loses, whichever is more.
double polarisation_change(const OrbInScene &orb, double impact_mm) {
    const auto key = [](const optics::Order &o) { return std::pair(o.glass_legs, o.hollow_chords); };
    std::map<std::pair<int, int>, double> change;
    for (const auto &o : orders_at(orb, impact_mm, optics::Polarisation::unpolarised)) change[key(o)] -= o.weight;
    for (const auto p : {optics::Polarisation::s, optics::Polarisation::p})
        for (const auto &o : orders_at(orb, impact_mm, p)) change[key(o)] += o.weight / 2;
    double gained = 0, lost = 0;
    for (const auto &[order, by] : change) (by > 0 ? gained : lost) += std::abs(by);
    return std::max(gained, lost);
}

double absorbed(const OrbInScene &orb, double impact_mm, double per_mm) {
    const double leg = optics::glass_leg_mm(orb.optics, optics::impact_at(orb.optics, impact_mm));
    double sum = 0;
    for (const auto &o : orders_at(orb, impact_mm, optics::Polarisation::unpolarised))
        sum += o.weight * -std::expm1(-per_mm * leg * o.glass_legs);
    return sum;
}

/// Light taken from its straight way by the orb may fall anywhere: by energy, all changes of irradiance together are no
/// more than twice the power that meets the orb, and no tile but the spare ones can have more than its part of that.
Bound caustics_of(const View &v) {
    double power = 0, nearest = infinity, reflectance = 0;
    for (const Directional &light : lights_on_diffuse(v.scene))
        power += (light.irradiance.r + light.irradiance.g + light.irradiance.b) / 3 * std::numbers::pi *
                 v.orb.optics.outer_mm * v.orb.optics.outer_mm;
    for (const SeenPoint &p : v.seen)
        if (p.is_surface() && p.reflectance > 0) {
            nearest = std::min(nearest, p.depth_mm);
            reflectance = std::max(reflectance, p.reflectance);
        }
    if (!(power > 0) || !(nearest < infinity))
        return Bound::none("no light meets the orb, or nothing in the picture is lit");
    const double tile_mm = nearest * 2 * film_half_width(v.scene.camera) / v.scene.camera.width_px * v.tile_px;
    const double spread = 2 * power / (tile_mm * tile_mm * static_cast<double>(v.spare() + 1));
    return {reflectance / std::numbers::pi * spread,
            fmt::format("energy conservation: {:.3g} of power meets the orb and may be taken from, and given to, tiles "
                        "of at least {:.3g} mm, of which {} may differ; reflectance at most {:.2g}",
                        power, tile_mm, v.spare(), reflectance)};
}

/// How much of the half space over a point is not sky, by the cosine: of directions on a spiral (Vogel, 1979).
double hidden_share(const SeenPoint &p, const std::vector<MeshRays> &meshes) {
    constexpr int directions = 48;
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    const Vec3 u = glm::normalize(glm::cross(std::abs(p.normal.y) < 0.9 ? Vec3(0, 1, 0) : Vec3(1, 0, 0), p.normal));
    const Vec3 w = glm::cross(p.normal, u);
    int hidden = 0;
    for (int k = 0; k < directions; ++k) {
        const double r = std::sqrt((k + 0.5) / directions), turn = golden * k;
        const Vec3 d = r * std::cos(turn) * u + r * std::sin(turn) * w + std::sqrt(1 - r * r) * p.normal;
        const Ray ray{p.point_mm + 1e-6 * p.depth_mm * p.normal, d};
        hidden += std::ranges::any_of(meshes, [&](const MeshRays &m) { return m.first_hit_mm(ray) < infinity; });
    }
    return static_cast<double>(hidden) / directions;
}

Mesh two_triangles(const Quad &quad) {
    const Vec3 u = quad.half_u_mm, v = quad.half_v_mm, c = quad.centre_mm;
    return {{c - u - v, c + u - v, c + u + v, c - u + v}, {{0, 1, 2}, {0, 2, 3}}, {}, quad.surface};
}

/// What hides the sky from a point is no brighter than the brightest thing seen, and lights itself likewise.
Bound interreflection_of(const View &v) {
    std::vector<MeshRays> meshes;
    double reflectance = 0, greatest = 0;
    for (const Object &object : v.scene.objects)
        if (const Mesh *mesh = std::get_if<Mesh>(&object.shape))
            meshes.emplace_back(*mesh);
        else if (const Quad *quad = std::get_if<Quad>(&object.shape))
            meshes.emplace_back(two_triangles(*quad));
    std::vector<double> hidden(static_cast<std::size_t>(v.columns()) * static_cast<std::size_t>(v.rows()), 0.0);
    const int half = v.tile_px / 2;
    for (int row = 0; row < v.rows(); ++row)
        for (int column = 0; column < v.columns(); ++column) {
            const int x = std::min(column * v.tile_px + half, v.scene.camera.image_width_px() - 1),
                      y = std::min(row * v.tile_px + half, v.scene.camera.image_height_px() - 1);
            const SeenPoint &p = v.at(x, y);
            double &share = hidden[v.tile_of(x, y)];
            if (p.is_surface() && p.reflectance > 0) share = hidden_share(p, meshes);
            greatest = std::max(greatest, share);
        }
    for (const SeenPoint &p : v.seen) reflectance = std::max(reflectance, p.reflectance);
    const double again = 1 / (1 - std::min(0.999, reflectance * greatest));
    const double value = worst_tile(v, [&](int column, int row) {
        return v.at(column, row).reflectance * hidden[v.tile_of(column, row)] * v.brightest * again;
    });
    return {value,
            fmt::format("albedo times form factor: the sky is hidden from up to {:.2g} of the half space (tile "
                        "centres), by things no brighter than {:.3g}, reflecting at most {:.2g}, all reflections",
                        greatest, v.brightest, reflectance)};
}

/// The same view in half its pixels.
Scene halved(Scene scene) {
    scene.camera.width_px = std::max(1, scene.camera.width_px / 2);
    scene.camera.height_px = std::max(1, scene.camera.height_px / 2);
    return scene;
}

Scene with_index(Scene scene, double index) {
    for (Object &object : scene.objects)
        if (Glass *glass = glass_of(object.shape)) glass->index = std::max(1.0, index);
    return scene;
}

/// A pinhole beside the eye whose picture agrees with the eye's at the orb.
Scene from_point_of_pupil(Scene scene, Vec2 aside_mm, double focus_mm) {
    Camera &camera = scene.camera;
    const CameraFrame frame = camera_frame(camera);
    const Vec3 shift = aside_mm.x * frame.right + aside_mm.y * frame.up;
    camera.eye_mm += shift;
    camera.target_mm += shift;
    const double pixel_mm = 2 * film_half_width(camera) / camera.width_px * focus_mm;
    camera.film_offset_px += Vec2(-aside_mm.x, aside_mm.y) / pixel_mm;
    return scene;
}

} // namespace

std::vector<ScopeNumber> picture_scope(const Experiment &e, const ScopeSettings &settings) {
    const View v = view_of(e);
    const ByImpact polarised(v.orb, [&](double b) { return polarisation_change(v.orb, b); });
    const ByImpact lost(v.orb, [&](double b) { return absorbed(v.orb, b, settings.absorption_per_mm); });
    const auto of_orb = [&](const ByImpact &share) {
        return worst_tile(v, [&](int column, int row) { return share(impact_at(v, column, row)) * v.brightest; });
    };
    const Scene half = halved(e.scene);
    const auto change = [&](std::vector<Scene> instead, bool as_mean) {
        return PictureChange{half, std::move(instead), as_mean, std::max(1, e.tile_px / 2), e.tiles_needed_share};
    };
    const double index = v.orb.optics.index, strain = optics::strain_index_difference(settings.strain_nm_per_cm);
    const auto at = [&](double nm) {
        return with_index(half, optics::index_at_wavelength(index, settings.abbe_number, nm));
    };
    std::vector<Scene> pinholes;
    const double focus = glm::length(v.orb.centre_mm - e.scene.camera.eye_mm);
    for (const Vec2 &aside : disc_points(settings.pupil_mm))
        pinholes.push_back(from_point_of_pupil(half, aside, focus));
    pinholes.push_back(half); // the middle weighs twice as much as each of the others
    const double tolerance = total(e.tile_budget(reference_accuracy(), reference_accuracy()));
    double mean = 0;
    for (const SeenPoint &p : v.seen) mean += p.radiance / static_cast<double>(v.seen.size());
    const std::string brightest = fmt::format("nothing that the orb shows is brighter than {:.3g}, the brightest thing "
                                              "seen in full light",
                                              v.brightest);
    return {
        {fmt::format("mean radiance of a tile of {} px, all but {:g} % of the tiles", e.tile_px,
                     100 * (1 - e.tiles_needed_share)),
         "", mean, tolerance, "the tolerance on a tile",
         EffectBounds{
             .polarisation = {of_orb(polarised),
                              "shares of all orders with s and p apart, against unpolarised ones; " + brightest},
             .dispersion = {change({at(settings.least_wavelength_nm), at(settings.greatest_wavelength_nm)}, false),
                            fmt::format("traced at the indices of {:g} and {:g} nm, Abbe number {:g}",
                                        settings.least_wavelength_nm, settings.greatest_wavelength_nm,
                                        settings.abbe_number)},
             .absorption = {of_orb(lost),
                            fmt::format("all orders weakened by exp(-{:g} per mm times their way in the glass); ",
                                        settings.absorption_per_mm) +
                                brightest},
             .birefringence = {change({with_index(half, index - strain), with_index(half, index + strain)}, false),
                               fmt::format("traced at both indices of glass strained by {:g} nm/cm",
                                           settings.strain_nm_per_cm)},
             .light_size = {change({with_discs(half, settings.light_deg)}, false),
                            fmt::format("traced with each light as seven over a disc of {:g} degrees",
                                        settings.light_deg)},
             .caustics = caustics_of(v),
             .interreflection = interreflection_of(v),
             .pupil = {change(std::move(pinholes), true),
                       fmt::format("traced from six points of a pupil of {:g} mm (and its middle), focused at the orb",
                                   settings.pupil_mm)}}}};
}

} // namespace threefold
