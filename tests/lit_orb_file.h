// SPDX-License-Identifier: MIT
// A scene of Mitsuba 0.5 written for tests: a hollow orb between a checked wall and the eye, in sun and sky, over a
// floor that reaches behind the eye.
#pragma once

namespace threefold {
inline namespace tests {

inline constexpr const char *lit_orb_xml = R"(<scene version="0.5.0">
<sensor type="perspective"><float name="fov" value="12"/>
<transform name="toWorld"><lookat origin="90,4,0" target="0,0,0" up="0,1,0"/></transform>
<film type="hdrfilm"><integer name="width" value="96"/><integer name="height" value="64"/></film></sensor>
<emitter type="constant"><spectrum name="radiance" value="0.6"/></emitter>
<emitter type="directional"><vector name="direction" x="-1" y="-1.5" z="0.7"/><spectrum name="irradiance" value="1.5"/></emitter>
<shape type="sphere" id="outside"><float name="radius" value="6.8"/>
<bsdf type="dielectric"><float name="intIOR" value="1.5"/><float name="extIOR" value="1"/></bsdf></shape>
<shape type="sphere" id="inside"><float name="radius" value="6.6"/><boolean name="flipNormals" value="true"/>
<bsdf type="dielectric"><float name="intIOR" value="1.5"/><float name="extIOR" value="1"/></bsdf></shape>
<shape type="rectangle" id="wall"><bsdf type="diffuse"><texture name="reflectance" type="gridtexture">
<spectrum name="color0" value="0.3"/><spectrum name="color1" value="0.8"/><float name="uscale" value="6"/>
<float name="vscale" value="6"/><float name="lineWidth" value="0.1"/></texture></bsdf>
<transform name="toWorld"><rotate y="1" angle="90"/><scale value="12"/><translate x="-15"/></transform></shape>
<shape type="rectangle" id="floor"><bsdf type="diffuse"><spectrum name="reflectance" value="0.5"/></bsdf>
<transform name="toWorld"><rotate x="1" angle="-90"/><scale value="200"/><translate y="-7"/></transform></shape>
</scene>)";

} // namespace tests
} // namespace threefold
