// "test"
// One unit is 0.01 mm, the origin is at <0,0,0> mm; radiance is multiplied by 0.9999847409781033.
#version 3.7;
global_settings {
  assumed_gamma 1.0
  max_trace_level 160
  adc_bailout 1e-06 // the weight below which a branch is dropped
}
camera {
  perspective
  location <0,0,90000>
  right <0.17497732705184801,-0,0>
  up <0,0.17497732705184801,0>
  direction <0,0,-1> + <0.00017087629594907033,0.00017087629594907033,0>
}
// "orb"
sphere {
  <0,0,0>, 6800
  pigment { rgbt <0,0,0,1> }
  finish { ambient 0 emission 0 diffuse 0 specular 0 }
  interior { ior 1.51714 }
  no_shadow
}
// "card"
polygon {
  5, <0,0>, <1,0>, <1,1>, <0,1>, <0,0>
  texture {
  pigment { average pigment_map {
    [1 function { min(1, max(0, x)) } color_map { [0 rgb 0] [1 rgb <3,0,0>] }]
    [1 function { min(1, max(0, y)) } color_map { [0 rgb 0] [1 rgb <0,3,0>] }]
    [1 rgb <0,0,3>]
  } }
  finish { ambient 0 specular 0 diffuse 0 emission 0.9999847409781033 }
  }
  matrix <30000,0,0, 0,30000,0, 0,0,30000, -15000,-15000,-20000>
}
