SCENE = json.loads(r'''{
 "name": "test",
 "unit_mm": 68.0,
 "origin_mm": [5.0,6.0,7.0],
 "camera": {"eye":[-0.07352941176470588,-13.132352941176471,-0.08823529411764706],"right":[1.0,0.0,0.0],"up":[0.0,0.0,1.0],"back":[0.0,-1.0,0.0],"width_px":64,"height_px":32,"farthest":56.531420816596814,"projection":"perspective","sensor_width":2.1872165881481003,"lens":50.0},
 "sampling": {"filter":"BOX","samples":16,"window":true},
 "environment": [0.0,0.0,0.0],
 "lights": [
  {"towards":[-0.3333333333333333,-0.6666666666666666,0.6666666666666666],"strength":2.0,"colour":[1.0,0.5,0.25]},
  {"towards":[-0.3333333333333333,-0.6666666666666666,0.6666666666666666],"strength":2.0,"colour":[1.0,0.5,0.25]}],
 "objects": [
  {"kind":"glass","name":"ball","centre":[0.0,0.0,0.0],"radii":[1.0],"sphere":{"file":"icosphere_4.bin","vertices":2562,"triangles":5120,"uv":false},"scale":1.000569265514032,"index":1.6,"transmittance":0.89,"antireflective":false,"shadow":{"rule":"constant","transmittance":0.64}},
  {"kind":"quad","name":"robe","corners":[[-2.073529411764706,3.7794117647058822,-2.088235294117647],[1.9264705882352942,3.7794117647058822,-2.088235294117647],[1.9264705882352942,3.7794117647058822,1.911764705882353],[-2.073529411764706,3.7794117647058822,1.911764705882353]],"surface":{"kind":"diffuse","reflectance":"texture_1.png"}},
  {"kind":"quad","name":"copy","corners":[[-2.073529411764706,3.7794117647058822,-2.088235294117647],[1.9264705882352942,3.7794117647058822,-2.088235294117647],[1.9264705882352942,3.7794117647058822,1.911764705882353],[-2.073529411764706,3.7794117647058822,1.911764705882353]],"surface":{"kind":"emissive","radiance":"texture_1.png","strength":1.0}},
  {"kind":"mesh","name":"hand","mesh":{"file":"mesh_1.bin","vertices":3,"triangles":1,"uv":false},"surface":{"kind":"diffuse","reflectance":[0.5,0.25,0.125]}}],
 "replicates": [
  {"output":"render_0001.exr","seed":7,"shift":[-1.33984375,1.4375]},
  {"output":"render_0002.exr","seed":4,"shift":[-1.33984375,1.4453125]}]
}''')

main(SCENE)
