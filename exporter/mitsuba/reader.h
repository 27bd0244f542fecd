// SPDX-License-Identifier: MIT
// What the parts of the reader share: parsed before they are put together, in the file's unit.
#pragma once

#include "exporter/mitsuba/properties.h"
#include "scenes/parameters.h"

namespace threefold::mitsuba {

/// The lines of a grid texture reach `line_width` of a cell to either side of each cell's border.
struct Grid {
    Rgb field{0.2}, line{0.4};
    Vec2 scale{1}, offset{0};
    double line_width = 0.01;
};

/// A surface as Mitsuba has it: its two sides may differ. A grid has its own two reflectances.
struct TwoSides {
    Surface front = Diffuse{Rgb(0.5)}, back = Diffuse{Rgb(0)};
    bool alike = false;
    std::optional<Grid> grid;
    bool coordinates = false; ///< its picture is that of the coordinate card
};

struct GlassSurface {
    double inside = 1, outside = 1; ///< indices on either side
    double transmittance = 1;
    bool thin = false; ///< a sheet without thickness
};

struct Sphere {
    const Node *node;
    std::string name;
    Vec3 centre_mm;
    double radius_mm;
    GlassSurface glass;
};

class Reader {
public:
    Reader(Document &document, const Parameters &parameters);

    Scene scene();

private:
    std::string name_of(const Node &node) const;
    std::shared_ptr<const Texture> bitmap(const Node &node, const std::string &shape, TwoSides &sides);
    bool is_clamped(const Node &node) const;
    Paint paint(const Node &node, const std::string &shape, TwoSides &sides);
    TwoSides surface(const Node &bsdf, const std::string &shape, int depth = 0);
    std::optional<GlassSurface> glass(const Node &bsdf);
    std::optional<TwoSides> painted(Properties &shape, const std::string &name);
    void emission(Properties &shape, const std::string &name, TwoSides &sides);

    void sphere(const Node &node);
    void rectangle(const Node &node);
    void mesh(const Node &node);
    void emitter(const Node &node);
    void sensor(const Node &node);
    void integrator(const Node &node);
    void film(const Node &node, const std::string &fov_axis, double fov);
    void put_glass_together();
    void put_surfaces_together();
    void fit_picture();

    struct Flat { ///< a rectangle or a mesh, whose visible side is chosen once eye and glass are known
        const Node *node;
        Object object;
        Vec3 normal{0};
        TwoSides sides;
    };
    std::pair<double, double> depths_of_view(Vec3 point, Vec3 normal) const;
    int side_of_view(const Flat &flat) const; ///< 1: only its front is seen, -1: only its back, 0: either
    void add_grid(const Flat &flat);

    Document &document_;
    Findings &findings_;
    const Parameters &parameters_;
    double unit_mm_;
    Scene scene_;
    std::vector<Sphere> spheres_;
    std::vector<Flat> flats_;
    std::map<std::string, std::string>
        wrap_; ///< shapes whose texture may repeat: uv outside the unit square is refused
    bool has_sensor_ = false;
};

/// Identifiers of the meshes of a file in order, with the names of their files as they resolve.
struct MeshInFile {
    std::string id;
    std::filesystem::path file;
};
std::vector<MeshInFile> meshes_of(const Tree &tree);

} // namespace threefold::mitsuba
