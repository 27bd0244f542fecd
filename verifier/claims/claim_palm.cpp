// SPDX-License-Identifier: MIT
// "A solid orb hides the palm behind it; a hollow one shows it in its place" (figure 3 of the study). Read by identity
// colours: the hand is red, all else is not.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "verifier/claims/claim.h"
#include "verifier/claims/flip.h"
#include "verifier/claims/palm.h"
#include "verifier/claims/scope_bounds.h"
#include "verifier/measure/contact.h"

namespace threefold {

namespace {

constexpr double most = 0.5;         ///< "shows it": more than half of it in its place; "hides it": less
constexpr int grid = 256;            ///< rays across the orb for the exact share: some ten thousand are the palm's
constexpr std::size_t fewest = 30;   ///< pixels (or rays) of palm: with fewer there is nothing to see
constexpr double coarse_relief = 60; ///< the robe only has to be behind
constexpr double picture_shape = 2072.0 / 1408;

constexpr const char *share = "share of the palm seen in its place";
constexpr const char *hidden = "share of the palm seen in its place through a solid orb (hidden)";
constexpr const char *shown = "share of the palm seen in its place through a hollow orb (shown)";

struct Setting {
    const ClaimContext &context;
    std::vector<Assignment> defaults, fixed;

    Experiment experiment(const std::string &name, const std::string &title,
                          const std::vector<Assignment> &more) const {
        std::vector<Assignment> all = fixed;
        all.insert(all.end(), more.begin(), more.end());
        return context.experiment(name, title, "salvator", defaults, all);
    }
};

Setting setting_of(const ClaimContext &context) {
    const int width = context.quick ? 176 : 352;
    Setting setting{context,
                    {assign("robe.relief_resolution", coarse_relief), assign("image.width_px", width),
                     assign("image.height_px", std::round(width * picture_shape))},
                    {assign("figure.surface", "identity"), assign("glass.coating", "antireflective"),
                     assign("glass.interface_transmittance", 1), assign("image.crop_x_px", 0),
                     assign("image.crop_y_px", 0), assign("image.crop_width_px", 0),
                     assign("image.crop_height_px", 0)}};
    const Scene whole = setting.experiment("", "", {}).scene;
    if (const auto crop = crop_around(orb_of(whole), whole.camera))
        for (const auto &[name, value] : {std::pair("image.crop_x_px", crop->x_px),
                                          {"image.crop_y_px", crop->y_px},
                                          {"image.crop_width_px", crop->width_px},
                                          {"image.crop_height_px", crop->height_px}})
            setting.fixed.push_back(assign(name, value));
    return setting;
}

/// Hand, robe and the palm's rays: the same for every orb of this size and place.
struct Exact {
    std::shared_ptr<const Palm> palm;
    std::vector<Ray> rays;
    bool apart; ///< a hand that reaches into the orb lies where no ray is followed

    explicit Exact(const Scene &scene) : palm(std::make_shared<const Palm>(scene)), rays(palm->rays(grid)) {
        const OrbInScene orb = orb_of(scene);
        apart = true;
        for (const Object &object : scene.objects)
            if (const Mesh *mesh = std::get_if<Mesh>(&object.shape))
                apart =
                    apart && clearance_mm(*mesh, {orb.centre_mm, orb.optics.outer_mm}) > -1e-6 * orb.optics.outer_mm;
    }

    bool can_be_told() const { return apart && rays.size() >= fewest; }
    double share_in_place(const OrbInScene &orb) const { return palm->share_in_place(orb, rays); }
};

/// Pixels of palm, and how many of them would show something else if their rays ran `shift_mm` beside.
struct Edges {
    double palm = 0, uncertain = 0;
};

Edges edges(const Palm &palm, const OrbInScene &orb, const Camera &camera, double shift_mm) {
    const CameraFrame frame = camera_frame(camera);
    Edges e;
    for (int row = 0; row < camera.image_height_px(); ++row)
        for (int column = 0; column < camera.image_width_px(); ++column) {
            const Ray ray = camera_ray(camera, pixel_sample(camera, column, row));
            if (!palm.is_palm(ray)) continue;
            e.palm += 1;
            const bool here = palm.shows_hand(orb, ray);
            for (const Vec3 aside : {frame.right, -frame.right, frame.up, -frame.up})
                if (palm.shows_hand(orb, {ray.origin_mm + shift_mm * aside, ray.direction}) != here) {
                    e.uncertain += 1;
                    break;
                }
        }
    return e;
}

bool is_hand(Rgb pixel) { return pixel.r > 0.5 && pixel.g < 0.5 && pixel.b < 0.5; }

/// Share measured minus share by exact optics, over the same rays.
double share_error(const Palm &palm, const OrbInScene &orb, const Image &image, const Camera &camera) {
    std::size_t pixels = 0;
    double error = 0;
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const Ray ray = camera_ray(camera, pixel_sample(camera, column, row));
            if (!palm.is_palm(ray)) continue;
            ++pixels;
            // What comes by total reflection is not seen through the orb, whatever its colour.
            if (!(impact_parameter(ray, orb.centre_mm) < orb.clear_radius_mm())) continue;
            error += double(is_hand(image.at(column, row))) - double(palm.shows_hand(orb, ray));
        }
    return pixels >= fewest ? error / static_cast<double>(pixels) : std::numeric_limits<double>::quiet_NaN();
}

/// `conclusion` is the quantity that must lie on `side` of `most`.
Experiment rendered(Experiment e, const Exact &exact, const char *conclusion, Relation side) {
    const OrbInScene orb = orb_of(e.scene);
    const Camera camera = e.scene.camera;
    e.sampling = Sampling::pixel_centres;
    e.samples_per_pixel = 1;
    e.shift_replicates = true;
    e.surface_tolerance_mm = 1e-4 * orb.optics.outer_mm;
    const double predicted = exact.can_be_told() ? exact.share_in_place(orb) : std::numeric_limits<double>::quiet_NaN();
    const double pixel = 2 * film_half_width(camera) / camera.width_px * glm::length(camera.eye_mm - orb.centre_mm);
    e.predict = [=, palm = exact.palm](const Accuracy &a) {
        const double shift = a.surface_mm + 2 * a.rounding_mm + a.filter_px * pixel;
        const Edges at = edges(*palm, orb, camera, shift);
        const double pixels = std::max(at.palm, 1.0);
        return std::vector<Expected>{
            {share,
             "",
             Relation::equal,
             predicted,
             {{"edges", at.uncertain / pixels,
               fmt::format("pixels that would show something else if their ray ran {:.2g} mm beside (tessellation, "
                           "arithmetic, filter)",
                           shift)},
              {"one pixel", 1 / pixels, "the edge of a triangle may run through a pixel's very sample"}}},
            {conclusion, "", side, most, {}}};
    };
    e.measure = [=, palm = exact.palm](const Image &image, const Camera &seen_by) {
        const double read = predicted + share_error(*palm, orb, image, seen_by);
        return std::vector<Reading>{{share, read}, {conclusion, read}};
    };
    return e;
}

struct Flip {
    std::string kind, parameter, unit, meaning;
    std::optional<double> value;
};

std::vector<Flip> flips_of(const Setting &setting, const Exact &exact) {
    std::vector<Flip> flips{
        {"solid", "glass.index", "", "only above this index does a solid orb hide most of the palm", {}},
        {"hollow",
         "orb.wall_mm",
         "mm",
         "only below this wall does a hollow orb show most of the palm in its place",
         {}}};
    if (!exact.can_be_told()) return flips;
    const OrbInScene ball = orb_of(setting.experiment("", "", {assign("orb.kind", "solid")}).scene);
    const OrbInScene shell = orb_of(setting.experiment("", "", {assign("orb.kind", "hollow")}).scene);
    const double radius = ball.optics.outer_mm;
    flips[0].value = root_between(
        [&](double index) {
            OrbInScene orb = ball;
            orb.optics = optics::solid_ball(radius, index);
            return exact.share_in_place(orb) - most;
        },
        1.0001, 2.5);
    flips[1].value = root_between(
        [&](double wall) {
            OrbInScene orb = shell;
            orb.optics = optics::shell(radius, wall, shell.optics.index);
            return exact.share_in_place(orb) - most;
        },
        1e-3 * radius, 0.98 * radius);
    return flips;
}

std::vector<Experiment> experiments(const ClaimContext &context) {
    const Setting setting = setting_of(context);
    std::vector<Experiment> all;
    const auto plain = [&](const std::string &kind) {
        return setting.experiment("palm-" + kind, fmt::format("the hand (red) behind and through the {} orb", kind),
                                  {assign("orb.kind", kind)});
    };
    Experiment solid = plain("solid");
    const Exact exact(solid.scene);
    all.push_back(rendered(std::move(solid), exact, hidden, Relation::below));
    all.push_back(rendered(plain("hollow"), exact, shown, Relation::above));
    for (const Flip &flip : flips_of(setting, exact)) {
        if (!flip.value) continue;
        for (const auto &[label, value] : bracket_of(*flip.value)) {
            Experiment e =
                setting.experiment(fmt::format("palm-{}-flip-{}", flip.kind, label),
                                   fmt::format("the hand through the {} orb with {} just {} where the conclusion flips",
                                               flip.kind, flip.parameter, label),
                                   {assign("orb.kind", flip.kind), assign(flip.parameter, value)});
            const bool is_above = exact.share_in_place(orb_of(e.scene)) > most;
            all.push_back(rendered(std::move(e), exact, flip.kind == "solid" ? hidden : shown,
                                   is_above ? Relation::above : Relation::below));
        }
    }
    return all;
}

std::vector<ScopeNumber> palm_scope(const ClaimContext &context, const ScopeSettings &settings) {
    constexpr int coarse_grid = 96; // rays across the orb: a thousand or so are the palm's
    const Setting setting = setting_of(context);
    std::vector<ScopeNumber> numbers;
    for (const std::string kind : {"solid", "hollow"}) {
        const Scene scene = setting.experiment("", "", {assign("orb.kind", kind)}).scene;
        const OrbInScene orb = orb_of(scene);
        const Exact exact(scene);
        const double nan = std::numeric_limits<double>::quiet_NaN();
        const auto at_index = [&](double n) {
            OrbInScene changed = orb;
            changed.optics.index = n;
            return exact.can_be_told() ? exact.share_in_place(changed) : nan;
        };
        const auto from_beside = [&](Vec2 aside) {
            const Palm palm(seen_from_beside(scene, aside));
            const std::vector<Ray> rays = palm.rays(coarse_grid);
            return exact.can_be_told() && !rays.empty() ? palm.share_in_place(orb, rays) : nan;
        };
        const double here = at_index(orb.optics.index);
        const IndexBounds index = by_index(orb.optics.index, settings, at_index);
        numbers.push_back({fmt::format("share of the palm seen in its place through a {} orb", kind), "", here,
                           margin_to(here, {most}), margin_words({most}, ""),
                           of_directions(scene, index, by_pupil(settings, from_beside))});
    }
    return numbers;
}

} // namespace

Claim claim_palm() {
    Claim claim;
    claim.name = "palm";
    claim.statement = "A solid orb hides the palm behind it; a hollow one shows it in its place.";
    claim.experiments = experiments;
    claim.summary = [](const ClaimContext &, Verdict verdict) {
        switch (verdict) {
        case Verdict::holds:
            return "Through the hollow orb most of the palm is seen where it is. The solid orb shows other things in "
                   "its place.";
        case Verdict::fails:
            return "Some renderer, or exact optics itself, contradicts the statement for this scene.";
        case Verdict::undecided:
            return "The renders do not settle the statement yet: is there a palm behind the orb, and clear of it?";
        }
        return "";
    };
    claim.notes = [](const ClaimContext &context) {
        const Setting setting = setting_of(context);
        const Experiment solid = setting.experiment("", "", {assign("orb.kind", "solid")}),
                         hollow = setting.experiment("", "", {assign("orb.kind", "hollow")});
        const Exact exact(solid.scene);
        if (!exact.apart)
            return std::vector<std::string>{"Something reaches into the orb: what is seen of it is not predicted."};
        if (!exact.can_be_told()) return std::vector<std::string>{"Hardly any of the hand lies behind the orb."};
        return std::vector{fmt::format(
            "The palm is what would be seen of the hand behind the orb if the orb bent no ray. By exact optics the "
            "solid orb shows {:.1f} % of it in its place, the hollow one {:.1f} %; the rest of it lies behind the rim, "
            "where light is totally reflected, and beside. Shown or hidden is more or less than half.",
            100 * exact.share_in_place(orb_of(solid.scene)), 100 * exact.share_in_place(orb_of(hollow.scene)))};
    };
    claim.flips = [](const ClaimContext &context) {
        const Setting setting = setting_of(context);
        const Experiment here = setting.experiment("", "", {assign("orb.kind", "solid")});
        std::vector<FlipPoint> points;
        for (const Flip &flip : flips_of(setting, Exact(here.scene)))
            if (flip.value)
                points.push_back(
                    {flip.parameter,
                     flip.unit,
                     *flip.value,
                     std::stod(here.record.parameters.at(flip.parameter)),
                     flip.meaning,
                     {fmt::format("palm-{}-flip-below", flip.kind), fmt::format("palm-{}-flip-above", flip.kind)}});
        return points;
    };
    claim.scope = palm_scope;
    claim.mutant = Fault::inner_surface_missing;
    return claim;
}

} // namespace threefold
