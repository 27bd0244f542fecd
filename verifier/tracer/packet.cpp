// SPDX-License-Identifier: MIT
#include "verifier/tracer/packet.h"

#include <cstdint>

namespace threefold::tracer {

namespace {

/// How far light that is dropped may add up, and how much of that one exit may be: shares of `cut`.
constexpr double dropped_exits = 0.5, one_exit = 1.0 / 32, one_state = 1e-3;
/// Of the light that roulette asks, one in so many goes on, with so many times its weight.
constexpr double survivors = 8;

THREEFOLD_INLINE double greatest_of(const Lanes &lanes_of) {
    double four[4];
    THREEFOLD_LANES
    for (int l = 0; l < 4; ++l) four[l] = lanes_of.v[l] > lanes_of.v[l + 4] ? lanes_of.v[l] : lanes_of.v[l + 4];
    const double a = four[0] > four[2] ? four[0] : four[2], b = four[1] > four[3] ? four[1] : four[3];
    return a > b ? a : b;
}

/// cosine of an angle by its sine, 0 where there is none.
THREEFOLD_INLINE double cosine_of(double sine) {
    const double square = (1 - sine) * (1 + sine);
    return __builtin_sqrt(square > 0 ? square : 0);
}

/// Of the angle at the hollow's sphere; 1 or more: the light passes the hollow by.
THREEFOLD_INLINE double inner_sine_of(const Orb<double> &orb, double impact) {
    return orb.inner > 0 ? orb.outer * (impact / orb.outer / orb.index) / orb.inner : 2;
}

/// All that is the same wherever the light is.
struct Constants {
    LaneVectors e1, e2;
    Lanes air_cosine, air_sine, outer_reflected, outer_passed, inner_reflected, inner_passed, entered;
    PacketScratch::Power step, across; ///< two walls, and the hollow; in solid glass `step` is one chord
};

THREEFOLD_INLINE void fresnel(double n1, double c1, double n2, double c2, double &reflected, double &transmitted) {
    const double s = n1 * c1 + n2 * c2, p = n2 * c1 + n1 * c2;
    const double rs = (n1 * c1 - n2 * c2) / s, rp = (n2 * c1 - n1 * c2) / p;
    const bool blind = !(s > 0) || !(p > 0);
    const double t = 4 * n1 * n2 * c1 * c2 * (1 / (s * s) + 1 / (p * p)) / 2;
    reflected = blind ? 1 : (rs * rs + rp * rp) / 2;
    transmitted = blind ? 0 : t;
}

THREEFOLD_INLINE void next_power(const PacketScratch::Power &step, const PacketScratch::Power &last,
                                 PacketScratch::Power &power) {
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) {
        const double c = last.cosine.v[l], s = last.sine.v[l];
        power.cosine.v[l] = c * step.cosine.v[l] - s * step.sine.v[l];
        power.sine.v[l] = c * step.sine.v[l] + s * step.cosine.v[l];
    }
}

THREEFOLD_INLINE void first_power(std::vector<PacketScratch::Power> &powers) {
    if (powers.size() < 16) powers.resize(16);
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) {
        powers[0].cosine.v[l] = 1;
        powers[0].sine.v[l] = 0;
    }
}

/// Where light leaves after the turn a * b.
THREEFOLD_INLINE void leave(const Orb<double> &orb, const Constants &k, const PacketScratch::Power &a,
                            const PacketScratch::Power &b, const Lanes &weight, double greatest,
                            PacketScratch &scratch) {
    if (scratch.count == scratch.exits.size()) scratch.exits.resize(2 * scratch.count + 16);
    ExitPacket &out = scratch.exits[scratch.count++];
    out.greatest = greatest;
    const double R = orb.outer, x = orb.centre.x, y = orb.centre.y, z = orb.centre.z;
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) {
        const double c = a.cosine.v[l] * b.cosine.v[l] - a.sine.v[l] * b.sine.v[l];
        const double s = a.cosine.v[l] * b.sine.v[l] + a.sine.v[l] * b.cosine.v[l];
        const double rx = c * k.e1.x.v[l] + s * k.e2.x.v[l], ry = c * k.e1.y.v[l] + s * k.e2.y.v[l],
                     rz = c * k.e1.z.v[l] + s * k.e2.z.v[l];
        const double tx = c * k.e2.x.v[l] - s * k.e1.x.v[l], ty = c * k.e2.y.v[l] - s * k.e1.y.v[l],
                     tz = c * k.e2.z.v[l] - s * k.e1.z.v[l];
        const double ac = k.air_cosine.v[l], as = k.air_sine.v[l];
        out.origin.x.v[l] = x + R * rx;
        out.origin.y.v[l] = y + R * ry;
        out.origin.z.v[l] = z + R * rz;
        out.direction.x.v[l] = ac * rx + as * tx;
        out.direction.y.v[l] = ac * ry + as * ty;
        out.direction.z.v[l] = ac * rz + as * tz;
        out.weight.v[l] = weight.v[l];
    }
}

/// The end of a tree: what was dropped so far, or the numbers of the roulette.
struct Ending {
    double cut;
    std::uint64_t roulette; ///< 0: none
    double dropped_most = 0;

    /// The tree ends with no more weight inside than this.
    THREEFOLD_INLINE double inside() const { return roulette != 0 ? cut : cut * (1 - dropped_exits); }

    /// True where so little weight is to be asked about: it goes on `survivors` times as heavy, or not at all.
    THREEFOLD_INLINE bool asks(double most, double little) const {
        return most < little && (roulette != 0 || dropped_most + most < cut * dropped_exits);
    }
    THREEFOLD_INLINE bool survives() {
        if (roulette == 0) return false;
        roulette = mix(roulette) | 1u;
        return static_cast<double>(roulette >> 11) * 0x1p-53 * survivors < 1;
    }
};

THREEFOLD_INLINE void multiply(Lanes &weight, double factor) {
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) weight.v[l] *= factor;
}

THREEFOLD_INLINE void drop(const Lanes &weight, double most, Ending &end, Lanes &dropped) {
    if (end.roulette != 0) return; // it has lost; its share lives on in those that won
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) dropped.v[l] += weight.v[l] > 0 ? weight.v[l] : 0;
    end.dropped_most += most;
}

/// Makes light of `weight` leave, unless it is too little to be missed.
THREEFOLD_INLINE void leave_or_drop(const Orb<double> &orb, const Constants &k, const PacketScratch::Power &a,
                                    const PacketScratch::Power &b, Lanes &weight, Ending &end, PacketScratch &scratch) {
    double most = greatest_of(weight);
    if (!(most > 0)) return;
    if (end.asks(most, end.cut * one_exit)) {
        if (!end.survives()) {
            drop(weight, most, end, scratch.dropped);
            return;
        }
        multiply(weight, survivors);
        most *= survivors;
    }
    leave(orb, k, a, b, weight, most, scratch);
}

/// One chord after another: a ball, or glass so thick that the hollow is passed by.
THREEFOLD_INLINE void follow_chords(const Orb<double> &orb, const Constants &k, Ending &end, PacketScratch &scratch) {
    Lanes weight = k.entered, passed;
    for (int met = 2; met <= orb.most_interfaces; ++met) {
        const double most = greatest_of(weight);
        if (!(most > end.inside())) {
            if (!(most > 0) || !end.survives()) break;
            multiply(weight, survivors);
        }
        const std::size_t last = met & 1, now = 1 - last; // the first is the start itself
        next_power(k.step, scratch.wall[last], scratch.wall[now]);
        THREEFOLD_LANES
        for (int l = 0; l < lanes; ++l) {
            passed.v[l] = weight.v[l] * k.outer_passed.v[l];
            weight.v[l] *= k.outer_reflected.v[l];
        }
        leave_or_drop(orb, k, scratch.wall[now], scratch.hollow[0], passed, end, scratch);
    }
    drop(weight, 0, end, scratch.dropped);
}

/// One step of the states with j + 1 walls behind them; the weight that leaves, and what stays inside in `live`.
THREEFOLD_INLINE void step(const Constants &k, const PacketScratch::State &now, PacketScratch::State &next,
                           PacketScratch::State &after, Lanes &live, Lanes &passed) {
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) {
        const double in = now.inward.v[l], out = now.outward.v[l], hollow = now.hollow.v[l];
        const double ri = k.inner_reflected.v[l], ti = k.inner_passed.v[l];
        const double o = in * ri + hollow * ti, h = in * ti + hollow * ri, i = out * k.outer_reflected.v[l];
        next.outward.v[l] = o;
        next.hollow.v[l] = h;
        after.inward.v[l] = i;
        live.v[l] += o + h + i;
        passed.v[l] = out * k.outer_passed.v[l];
    }
}

THREEFOLD_INLINE Lanes sum_of(const PacketScratch::State &state) {
    Lanes sum;
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) sum.v[l] = state.inward.v[l] + state.outward.v[l] + state.hollow.v[l];
    return sum;
}

THREEFOLD_INLINE void multiply(PacketScratch::State &state, double factor) {
    multiply(state.inward, factor);
    multiply(state.outward, factor);
    multiply(state.hollow, factor);
}

/// Takes a state at an end of the list away, where it has next to no weight.
THREEFOLD_INLINE bool forget(PacketScratch::State &state, Ending &end, Lanes &live, Lanes &dropped) {
    Lanes sum = sum_of(state);
    const double most = greatest_of(sum);
    if (most > 0 && !end.asks(most, end.cut * one_state)) return false;
    const bool stays = most > 0 && end.survives();
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) live.v[l] += stays ? (survivors - 1) * sum.v[l] : -sum.v[l];
    if (stays)
        multiply(state, survivors);
    else
        drop(sum, most, end, dropped);
    return !stays;
}

/// Through wall and hollow. Entry j of a generation has crossed the wall 2j (inward) or 2j + 1 times, and the hollow as
/// often as there are steps left.
THREEFOLD_INLINE void follow_shell(const Orb<double> &orb, const Constants &k, Ending &end, PacketScratch &scratch) {
    std::size_t walls = 1, hollows = 1, from = 0, to = 1;
    if (scratch.now.empty()) {
        scratch.now.resize(16);
        scratch.next.resize(16);
    }
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) {
        scratch.now[0].inward.v[l] = k.entered.v[l];
        scratch.now[0].outward.v[l] = scratch.now[0].hollow.v[l] = 0;
    }
    Lanes live = k.entered, passed;
    std::size_t steps = 0;
    for (; from < to && static_cast<int>(steps) + 2 <= orb.most_interfaces; ++steps) {
        const double most = greatest_of(live);
        if (!(most > end.inside())) {
            if (!(most > 0) || !end.survives()) break;
            for (std::size_t j = from; j < to; ++j) multiply(scratch.now[j], survivors);
        }
        if (scratch.next.size() < to + 2) scratch.next.resize(2 * to + 2);
        if (scratch.now.size() < to + 2) scratch.now.resize(2 * to + 2);
        THREEFOLD_LANES
        for (int l = 0; l < lanes; ++l) {
            live.v[l] = 0;
            scratch.next[from].inward.v[l] = 0;
            scratch.next[to].outward.v[l] = scratch.next[to].hollow.v[l] = 0;
        }
        for (std::size_t j = from; j < to; ++j) {
            step(k, scratch.now[j], scratch.next[j], scratch.next[j + 1], live, passed);
            if (steps < 2 * j + 1) continue;
            const std::size_t hollow_crossings = steps - 2 * j - 1;
            while (walls <= j + 1) {
                if (scratch.wall.size() == walls) scratch.wall.resize(2 * walls);
                next_power(k.step, scratch.wall[walls - 1], scratch.wall[walls]);
                ++walls;
            }
            while (hollows <= hollow_crossings) {
                if (scratch.hollow.size() == hollows) scratch.hollow.resize(2 * hollows);
                next_power(k.across, scratch.hollow[hollows - 1], scratch.hollow[hollows]);
                ++hollows;
            }
            leave_or_drop(orb, k, scratch.wall[j + 1], scratch.hollow[hollow_crossings], passed, end, scratch);
        }
        ++to;
        while (to > from && forget(scratch.next[to - 1], end, live, scratch.dropped)) --to;
        while (to > from && forget(scratch.next[from], end, live, scratch.dropped)) ++from;
        scratch.now.swap(scratch.next);
    }
    drop(live, 0, end, scratch.dropped);
}

} // namespace

THREEFOLD_VECTOR
void camera_rays(const Film &film, const PixelSampler &sampler, std::uint32_t first, Vec2 corner_px, RayPacket &rays) {
    const std::uint32_t order = sampler.key(0), key_x = sampler.key(1), key_y = sampler.key(2);
    alignas(64) std::uint32_t across[lanes], down[lanes];
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) {
        const std::uint32_t k = owen_scramble(first + static_cast<std::uint32_t>(l), order);
        across[l] = owen_scramble(reverse_bits(k), key_x);
        down[l] = owen_scramble(second_dimension(k), key_y);
    }
    if (!sampler.is_sobol())
        for (int l = 0; l < lanes; ++l) {
            const Vec2 at = sampler.position(first + static_cast<std::uint32_t>(l));
            across[l] = static_cast<std::uint32_t>(at.x * 0x1p32);
            down[l] = static_cast<std::uint32_t>(at.y * 0x1p32);
        }
    const CameraFrame &f = film.frame();
    const Vec3 eye = film.eye_mm();
    const double pixel = film.pixel(), half = 2147483648.0;
    const Vec2 corner = film.corner_px() + corner_px, middle = film.middle_px();
    const bool perspective = film.is_perspective();
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) {
        // By way of a signed number: few instruction sets turn an unsigned one into a double.
        const double u = (static_cast<double>(static_cast<std::int32_t>(across[l] ^ 0x80000000u)) + half) * 0x1p-32;
        const double v = (static_cast<double>(static_cast<std::int32_t>(down[l] ^ 0x80000000u)) + half) * 0x1p-32;
        const double x = (corner.x + u - middle.x) * pixel, y = (middle.y - (corner.y + v)) * pixel;
        const double px = x * f.right.x + y * f.up.x, py = x * f.right.y + y * f.up.y, pz = x * f.right.z + y * f.up.z;
        const double dx = f.forward.x + px, dy = f.forward.y + py, dz = f.forward.z + pz;
        const double scale = 1 / __builtin_sqrt(dx * dx + dy * dy + dz * dz);
        rays.origin.x.v[l] = perspective ? eye.x : eye.x + px;
        rays.origin.y.v[l] = perspective ? eye.y : eye.y + py;
        rays.origin.z.v[l] = perspective ? eye.z : eye.z + pz;
        rays.direction.x.v[l] = perspective ? dx * scale : f.forward.x;
        rays.direction.y.v[l] = perspective ? dy * scale : f.forward.y;
        rays.direction.z.v[l] = perspective ? dz * scale : f.forward.z;
    }
}

THREEFOLD_VECTOR
void intersect(const Orb<double> &orb, const RayPacket &rays, EntryPacket &entry) {
    const double x = orb.centre.x, y = orb.centre.y, z = orb.centre.z, R = orb.outer;
    Lanes hit;
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) {
        const double cx = x - rays.origin.x.v[l], cy = y - rays.origin.y.v[l], cz = z - rays.origin.z.v[l];
        const double dx = rays.direction.x.v[l], dy = rays.direction.y.v[l], dz = rays.direction.z.v[l];
        const double along = cx * dx + cy * dy + cz * dz;
        const double ax = along * dx - cx, ay = along * dy - cy, az = along * dz - cz;
        const double slip = ax * dx + ay * dy + az * dz;
        const double fx = ax - slip * dx, fy = ay - slip * dy, fz = az - slip * dz;
        const double impact = __builtin_sqrt(fx * fx + fy * fy + fz * fz);
        const double square = (R - impact) * (R + impact);
        const double depth = __builtin_sqrt(square > 0 ? square : 0);
        entry.distance.v[l] = along - depth;
        entry.impact.v[l] = impact;
        entry.depth.v[l] = depth;
        entry.foot.x.v[l] = fx;
        entry.foot.y.v[l] = fy;
        entry.foot.z.v[l] = fz;
        const double ahead = along > 0 ? 1 : 0;
        hit.v[l] = impact < R ? ahead : 0;
    }
    entry.hits = 0;
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) entry.hits |= static_cast<std::uint32_t>(hit.v[l] > 0) << l;
}

std::uint32_t same_way(const Orb<double> &orb, const EntryPacket &entry, std::uint32_t active) {
    std::uint32_t by_hollow = 0;
    for (int l = 0; l < lanes; ++l)
        by_hollow |= static_cast<std::uint32_t>(inner_sine_of(orb, entry.impact[l]) < 1) << l;
    const std::uint32_t first = active & (~active + 1);
    return active & (by_hollow & first ? by_hollow : ~by_hollow);
}

THREEFOLD_VECTOR
bool trace_packet(const Orb<double> &orb, const RayPacket &rays, const EntryPacket &entry, std::uint32_t active,
                  double cut, std::uint64_t roulette, PacketScratch &scratch) {
    if (orb.coating != Coating::fresnel || active == 0) return false;
    const double R = orb.outer, n = orb.index, tau = orb.interface_transmittance;
    const double hollow_n = orb.hollow_index, inner_tau = orb.inner_transmittance;
    Lanes on, inner_sine, glass_sine, glass_cosine;
    Constants k;
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) on.v[l] = (active >> l & 1u) ? 1 : 0;

    std::uint32_t by_hollow = 0;
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) {
        glass_sine.v[l] = entry.impact.v[l] / R / n;
        inner_sine.v[l] = inner_sine_of(orb, entry.impact.v[l]);
    }
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) by_hollow |= static_cast<std::uint32_t>(inner_sine.v[l] < 1) << l;
    by_hollow &= active;
    if (by_hollow != 0 && by_hollow != active) return false;

    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) {
        const double b = entry.impact.v[l], depth = entry.depth.v[l];
        const double as = b / R, ac = depth / R, gs = glass_sine.v[l], gc = cosine_of(gs);
        glass_cosine.v[l] = gc;
        const double over_b = b > 0 ? 1 : 0, safe_b = b > 0 ? b : 1;
        const double fx = entry.foot.x.v[l], fy = entry.foot.y.v[l], fz = entry.foot.z.v[l];
        const double dx = rays.direction.x.v[l], dy = rays.direction.y.v[l], dz = rays.direction.z.v[l];
        k.air_sine.v[l] = as;
        k.air_cosine.v[l] = ac;
        k.e1.x.v[l] = (fx - depth * dx) / R;
        k.e1.y.v[l] = (fy - depth * dy) / R;
        k.e1.z.v[l] = (fz - depth * dz) / R;
        k.e2.x.v[l] = ac * (over_b * fx / safe_b) + as * dx;
        k.e2.y.v[l] = ac * (over_b * fy / safe_b) + as * dy;
        k.e2.z.v[l] = ac * (over_b * fz / safe_b) + as * dz;
        double reflected, transmitted;
        fresnel(1, ac, n, gc, reflected, transmitted);
        const double o = on.v[l];
        k.outer_reflected.v[l] = o * reflected;
        k.outer_passed.v[l] = o * transmitted * tau;
        k.entered.v[l] = o * transmitted * tau;
        scratch.dropped.v[l] = 0;
    }
    scratch.count = 0;
    Ending end{cut, roulette};
    first_power(scratch.wall);
    first_power(scratch.hollow);
    const double most_reflected = greatest_of(k.outer_reflected);
    if (most_reflected > 0)
        leave(orb, k, scratch.wall[0], scratch.hollow[0], k.outer_reflected, most_reflected, scratch);

    if (by_hollow == 0) {
        THREEFOLD_LANES
        for (int l = 0; l < lanes; ++l) {
            const double s = glass_sine.v[l];
            k.step.cosine.v[l] = 2 * s * s - 1;
            k.step.sine.v[l] = 2 * s * glass_cosine.v[l];
        }
        follow_chords(orb, k, end, scratch);
        return true;
    }
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) {
        const double is = inner_sine.v[l] < 1 ? inner_sine.v[l] : 1, ic = cosine_of(is);
        const double gs = glass_sine.v[l], gc = glass_cosine.v[l];
        const double wc = ic * gc + is * gs, ws = is * gc - ic * gs;
        k.step.cosine.v[l] = wc * wc - ws * ws;
        k.step.sine.v[l] = 2 * wc * ws;
        const double hollow_sine = n * is / hollow_n;
        const double hs = hollow_sine < 1 ? hollow_sine : 1, hc = cosine_of(hs);
        k.across.cosine.v[l] = 2 * hs * hs - 1;
        k.across.sine.v[l] = 2 * hs * hc;
        double reflected, transmitted;
        fresnel(n, ic, hollow_n, hc, reflected, transmitted);
        const bool total = hollow_sine >= 1;
        k.inner_reflected.v[l] = total ? 1 : reflected;
        k.inner_passed.v[l] = total ? 0 : transmitted * inner_tau;
    }
    follow_shell(orb, k, end, scratch);
    return true;
}

} // namespace threefold::tracer
