// SPDX-License-Identifier: MIT
// Balls and shells. A shell is one difference with one interior: were the hollow a sphere of index 1 inside a sphere of
// glass, POV-Ray would compare an interior with itself on leaving it and reflect nothing there.
#include "exporter/povray/writer.h"

#include <cmath>

#include <fmt/format.h>

#include "scenes/validate.h"

namespace threefold::povray {
namespace {

/// `transmit` multiplies light that crosses the interface, each time, and not what is reflected: neither the Fresnel
/// part nor total reflection. Without `reflection` POV-Ray still reflects totally beyond the critical angle, which is
/// the ideal coating.
std::string material(const Glass &glass) {
    const auto reflection = [](Coating coating) {
        switch (coating) {
        case Coating::fresnel:
            return " reflection { 0, 1 fresnel on } conserve_energy"; // transmits 1 - F
        case Coating::antireflective:
            return "";
        }
        return "";
    };
    return fmt::format("  pigment {{ rgbt <0,0,0,{}> }}\n"
                       "  finish {{ ambient 0 emission 0 diffuse 0 specular 0{} }}\n"
                       "  interior {{ ior {} }}\n",
                       number(glass.interface_transmittance), reflection(glass.coating), number(glass.index));
}

std::string sphere(const Vec3 &centre, double radius) {
    return fmt::format("sphere {{ {}, {} }}", vector(centre), number(radius));
}

/// The shadow that the rule of the scene asks for comes from a black or grey sphere that no other ray can see, crossed
/// twice by straight light. The glass itself casts none.
void write_shadow(Writer &writer, const Vec3 &centre, double radius) {
    const auto straight_transmittance = [](const GlassShadow &shadow) {
        switch (shadow.rule) {
        case GlassShadow::Rule::none:
            return 1.0;
        case GlassShadow::Rule::opaque:
            return 0.0;
        case GlassShadow::Rule::constant:
            return shadow.transmittance;
        case GlassShadow::Rule::caustic:
            break; // refused wherever it would be seen
        }
        return 1.0;
    };
    const double transmittance = straight_transmittance(writer.job.scene.glass_shadow);
    if (transmittance == 1 || !needs(writer.job.scene).glass_shadow) return;
    writer.text += fmt::format("sphere {{\n  {}, {}\n  pigment {{ rgbt <0,0,0,{}> }}\n"
                               "  finish {{ ambient 0 emission 0 diffuse 0 specular 0 }}\n"
                               "  no_image no_reflection\n}}\n",
                               vector(centre), number(radius), number(std::sqrt(transmittance)));
}

} // namespace

void write_ball(Writer &writer, const GlassBall &ball) {
    const Vec3 centre = writer.space.point(ball.centre_mm);
    const double radius = writer.space.length(ball.radius_mm);
    writer.text +=
        fmt::format("sphere {{\n  {}, {}\n{}  no_shadow\n}}\n", vector(centre), number(radius), material(ball.glass));
    write_shadow(writer, centre, radius);
}

void write_shell(Writer &writer, const GlassShell &shell) {
    if (shell.inner_radius_mm() <= 0) return write_ball(writer, {shell.centre_mm, shell.outer_radius_mm, shell.glass});
    const Vec3 centre = writer.space.point(shell.centre_mm);
    const double outer = writer.space.length(shell.outer_radius_mm);
    writer.text += fmt::format("difference {{\n  {}\n  {}\n{}  no_shadow\n}}\n", sphere(centre, outer),
                               sphere(centre, writer.space.length(shell.inner_radius_mm())), material(shell.glass));
    write_shadow(writer, centre, outer);
}

} // namespace threefold::povray
