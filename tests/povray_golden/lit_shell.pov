// "test"
// One unit is 0.01 mm, the origin is at <10,0,0> mm; radiance is multiplied by 1.396242095981645.
#version 3.7;
global_settings {
  assumed_gamma 1.0
  max_trace_level 256
  adc_bailout 1e-06 // the weight below which a branch is dropped
}
#declare film_shift = array[6] {
  <-8.34157372421084e-05,8.283922514518565e-05,0>,
  <8.34157372421084e-05,-8.283922514518565e-05,0>,
  <9.195514803488174e-05,-7.979607231762133e-05,0>,
  <-9.195514803488174e-05,7.979607231762133e-05,0>,
  <1.3388952846120448e-05,6.93156835731542e-05,0>,
  <-1.3388952846120448e-05,-6.93156835731542e-05,-0>
}
camera {
  perspective
  location <-1000,0,90000>
  right <0.043744331762962003,-0,0>
  up <0,0.021872165881481002,0>
  direction <-0.05878144580648019,0.06288247690925788,-1> + film_shift[frame_number - 1]
}
light_source { <-90005.55538409838,180011.11076819676,180011.11076819676>, rgb <1.3333129879708043,1.3333129879708043,1.3333129879708043> parallel point_at 0 }
// "orb"
difference {
  sphere { <0,0,0>, 6800 }
  sphere { <0,0,0>, 6664 }
  pigment { rgbt <0,0,0,0.89> }
  finish { ambient 0 emission 0 diffuse 0 specular 0 reflection { 0, 1 fresnel on } conserve_energy }
  interior { ior 1.51714 }
  no_shadow
}
sphere {
  <0,0,0>, 6800
  pigment { rgbt <0,0,0,0.5> }
  finish { ambient 0 emission 0 diffuse 0 specular 0 }
  no_image no_reflection
}
// "wall"
polygon {
  5, <0,0>, <1,0>, <1,1>, <0,1>, <0,0>
  texture {
  pigment { rgb <0.25,0.5,0.75> }
  finish { ambient 0 specular 0 emission 0 diffuse 1 brilliance 1 }
  }
  matrix <30000,0,0, 0,30000,0, 0,0,30000, -16000,-15000,-20000>
}
