// SPDX-License-Identifier: MIT
// What the parts of the POV-Ray adapter share: its coordinates, how numbers are written, and how it refuses.
// POV-Ray compares distances with fixed numbers in its own units (nearer than 1e-4: the same surface; beyond 1e7:
// nothing), so the orb is moved to the origin and the unit is chosen for each scene.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "exporter/job.h"
#include "scenes/access.h"

namespace threefold::povray {

/// Throws Error(Exit::bad_data): POV-Ray cannot say this exactly, and something near it is not offered instead.
[[noreturn]] void refuse(const std::string &what, const std::string &hint = {});

/// The shortest decimal that reads back as the same double.
std::string number(double value);
/// "<x,y,z>"
std::string vector(const glm::dvec3 &v);
/// A user's text as it may stand in a comment: one line of ASCII in quotes.
std::string in_quotes(std::string_view text);

/// POV-Ray's coordinates: right-handed as ours (every vector of the camera is given), in units of its own.
struct Space {
    Vec3 origin_mm{0};
    double units_per_mm = 1;
    double extent = 0;             ///< of the scene about the origin, in units
    double smallest_sphere_mm = 0; ///< of glass; infinite without

    Vec3 point(const Vec3 &mm) const { return (mm - origin_mm) * units_per_mm; }
    double length(double mm) const { return mm * units_per_mm; }
};

/// Throws when no unit keeps the farthest point and the smallest gap of glass both within what POV-Ray can tell apart.
Space choose_space(const Scene &scene);

/// How a pixel is sampled: `pictures` of `supersampling` x `supersampling` samples a pixel, each shifted by its own.
struct Grid {
    int supersampling = 1;
    int pictures = 1;
};

/// A POV-Ray scene while it is being written.
struct Writer {
    const RenderJob &job;
    Grid grid;
    Space space;
    double radiance_scale = 1;
    double mesh_rounding_mm = 0; ///< meshes are in single precision there
    std::string text;
    std::vector<ExportedFile> textures;
    std::vector<const Texture *> texture_of_file;
};

// The parts of a scene, in the order in which they are written.
void refuse_what_cannot_be_said(const RenderJob &job);
void write_camera(Writer &writer);
void write_lights(Writer &writer);
void write_object(Writer &writer, const Object &object);

void write_ball(Writer &writer, const GlassBall &ball);
void write_shell(Writer &writer, const GlassShell &shell);
void write_quad(Writer &writer, const Quad &quad);
void write_mesh(Writer &writer, const Mesh &mesh);

/// "texture { ... }" over the unit square of the object's coordinates, or of a mesh's uv.
std::string surface_texture(Writer &writer, const Surface &surface, bool by_uv);
/// How much brighter than the whole scene one picture may be, in which a share of the lights stands for all; at
/// least 1.
double greatest_share(const Scene &scene, const Grid &grid);
bool needs_uv(const Surface &surface);

} // namespace threefold::povray
