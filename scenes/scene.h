// SPDX-License-Identifier: MIT
// The vocabulary: what stands before the camera. Plain values; knows no renderer.
// Frame: right-handed, +y up. Lengths in millimetres, angles in degrees, radiance linear with Rec. 709 primaries.
// Image row 0 is on top; a film position (x_px, y_px) has pixel (i, j) centred at (i + 0.5, j + 0.5).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace threefold {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Rgb = glm::dvec3;

// ---------------------------------------------------------------------------------------------------------------------
// Glass

/// How an interface splits light. `fresnel`: unpolarised Fresnel reflectance, as renderers do it.
/// `antireflective`: the ideal coating, all light is transmitted below the critical angle and all is reflected above
/// it; one ray stays one ray, so that a probe sees the refracted path alone.
enum class Coating { fresnel, antireflective };

struct Glass {
    double index = 1.51714;             ///< relative to the air outside and in a shell's hollow; at least 1
    double interface_transmittance = 1; ///< factor on light that crosses an interface (not on reflected light), 0 to 1
    Coating coating = Coating::fresnel;
};

struct GlassBall {
    Vec3 centre_mm{0};
    double radius_mm = 68;
    Glass glass;
};

/// A hollow orb: glass between two concentric spheres, air inside. One object; each adapter lowers it in its own way.
struct GlassShell {
    Vec3 centre_mm{0};
    double outer_radius_mm = 68;
    double wall_mm = 1.36;
    Glass glass;

    double inner_radius_mm() const { return outer_radius_mm - wall_mm; }
};

// ---------------------------------------------------------------------------------------------------------------------
// Surfaces

/// A linear image: radiance or reflectance = sample / 65535, bilinear between texel centres, clamped at the edges.
/// 16-bit samples because both external programs read just these exactly. Row 0 is the top (v = 1).
struct Texture {
    int width = 0, height = 0;
    std::vector<std::uint16_t> rgb; ///< width * height * 3, row-major

    bool operator==(const Texture &) const = default;
};

using Paint = std::variant<Rgb, std::shared_ptr<const Texture>>;

struct Diffuse {
    Paint reflectance = Rgb(0.5);
};

/// Emits the same radiance in all directions, from both sides, and reflects nothing. A thing to be seen: it casts
/// shadows, and lights no diffuse surface.
struct Emissive {
    Paint radiance = Rgb(1);
};

/// The probe: emits (u, v, 1), so that red/blue and green/blue of a pixel say where on the card its ray landed.
struct CoordinateCard {};

using Surface = std::variant<Diffuse, Emissive, CoordinateCard>;

// ---------------------------------------------------------------------------------------------------------------------
// Shapes

/// The rectangle centre + (2u - 1) half_u + (2v - 1) half_v with u, v in [0, 1]; half_u and half_v are perpendicular.
/// Seen with half_u to the right and half_v up, a texture stands upright. Both sides are alike.
struct Quad {
    Vec3 centre_mm{0};
    Vec3 half_u_mm{1, 0, 0};
    Vec3 half_v_mm{0, 1, 0};
    Surface surface = Diffuse{};
};

/// Triangles by index into vertices_mm; `uv` is empty or one per vertex (v = 1 at the top of a texture); flat shaded.
struct Mesh {
    std::vector<Vec3> vertices_mm;
    std::vector<glm::uvec3> triangles;
    std::vector<Vec2> uv;
    Surface surface = Diffuse{};
};

using Shape = std::variant<GlassBall, GlassShell, Quad, Mesh>;

struct Object {
    std::string name; ///< any text; adapters escape it
    Shape shape;
};

// ---------------------------------------------------------------------------------------------------------------------
// Light

/// Parallel light; `irradiance` is measured on a plane that faces the light.
struct Directional {
    Vec3 travel{0, -1, 0}; ///< direction in which the light goes; need not be normalised
    Rgb irradiance{1};
};

/// The same radiance from every direction. Diffuse surfaces are lit by it as by a dome of so many parallel lights
/// (scenes/light.h), which every renderer can say exactly; without a dome it would have to be an integral.
struct Environment {
    Rgb radiance{0};
    int dome_directions = 0;
};

/// How light passes glass on its way to a diffuse surface. `constant`: the whole orb lets through the share
/// `transmittance` in a straight line. Part of the scene, because renderers differ in it by default.
struct GlassShadow {
    enum class Rule { none, opaque, constant, caustic } rule = Rule::none;
    double transmittance = 1;
};

// ---------------------------------------------------------------------------------------------------------------------
// Camera

enum class Projection { perspective, orthographic };

/// A window of the full film, in pixels.
struct Crop {
    int x_px = 0, y_px = 0, width_px = 0, height_px = 0;
};

struct Camera {
    Projection projection = Projection::perspective;
    Vec3 eye_mm{0, 0, 900};
    Vec3 target_mm{0};
    Vec3 up{0, 1, 0};
    double horizontal_fov_deg = 10;      ///< perspective: full angle over the film's width, 0 to 180 exclusive
    double orthographic_width_mm = 150;  ///< orthographic: what the film's width covers
    int width_px = 256, height_px = 256; ///< the full film; pixels are square
    std::optional<Crop> crop;
    /// Where in a pixel its ray goes, measured from the pixel's centre. Renderers that take one sample per pixel are
    /// given sub-pixel shifts through it.
    Vec2 film_offset_px{0, 0};

    int image_width_px() const { return crop ? crop->width_px : width_px; }
    int image_height_px() const { return crop ? crop->height_px : height_px; }
};

struct Scene {
    std::string name; ///< any text; adapters escape it
    std::vector<Object> objects;
    std::vector<Directional> lights;
    std::optional<Environment> environment;
    GlassShadow glass_shadow;
    Camera camera;
};

/// Helper for std::visit: `std::visit(overloaded{[](const GlassBall &) {...}, ...}, shape)`. Never write a generic
/// lambda in it: the compiler then names every place that forgot a new shape.
template <class... Ts>
struct overloaded : Ts... {
    using Ts::operator()...;
};
template <class... Ts>
overloaded(Ts...) -> overloaded<Ts...>;

} // namespace threefold
