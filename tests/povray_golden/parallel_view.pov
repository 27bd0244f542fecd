// "test"
// One unit is 0.01 mm, the origin is at <0,0,0> mm; radiance is multiplied by 0.49999237048905165.
#version 3.7;
global_settings {
  assumed_gamma 1.0
  max_trace_level 256
  adc_bailout 1e-06 // the weight below which a branch is dropped
}
#declare film_shift = array[2] {
  <-7.150846796630223,7.101425070972709,0>,
  <7.150846796630223,-7.101425070972709,0>
}
camera {
  orthographic
  location <0,0,90000> + film_shift[frame_number - 1]
  right <15000,-0,0>
  up <0,15000,0>
  direction <0,0,-1>
}
background { rgb <0.04999923704890517,0.09999847409781033,0.9999847409781033> }
// "relief"
mesh2 {
  vertex_vectors { 3,
    <-1500,-1500,-150>,
    <1500,-1500,-150>,
    <-1500,1500,150>
  }
  uv_vectors { 3,
    <0,0>,
    <1,0>,
    <0,1>
  }
  face_indices { 1,
    <0,1,2>
  }
  translate <1500,1500,150>
  texture {
  pigment { uv_mapping image_map { png "texture-0.png" gamma 1.0 map_type 0 interpolate 2 } scale <2,3,1> translate <-0.5,-1,0> }
  finish { ambient 0 specular 0 diffuse 0 emission 0.49999237048905165 }
  }
}
// "picture"
polygon {
  5, <0,0>, <1,0>, <1,1>, <0,1>, <0,0>
  texture {
  pigment { image_map { png "texture-0.png" gamma 1.0 map_type 0 interpolate 2 } scale <2,3,1> translate <-0.5,-1,0> }
  finish { ambient 0 specular 0 diffuse 0 emission 0.49999237048905165 }
  }
  matrix <30000,0,0, 0,30000,0, 0,0,30000, -15000,-15000,-20000>
}
