SCENE = json.loads(r'''{
 "name": "test",
 "unit_mm": 68.0,
 "origin_mm": [0.0,0.0,0.0],
 "camera": {"eye":[0.0,-13.235294117647058,0.0],"right":[1.0,0.0,0.0],"up":[0.0,0.0,1.0],"back":[0.0,-1.0,0.0],"width_px":256,"height_px":256,"farthest":56.94117647058823,"projection":"perspective","sensor_width":8.748866352592401,"lens":50.0},
 "sampling": {"filter":"GAUSSIAN","samples":1,"window":false},
 "environment": [0.0,0.0,0.0],
 "lights": [],
 "objects": [
  {"kind":"glass","name":"orb","centre":[0.0,0.0,0.0],"radii":[1.0,0.98],"sphere":{"file":"icosphere_4.bin","vertices":2562,"triangles":5120,"uv":false},"scale":1.000569265514032,"index":1.51714,"transmittance":1.0,"antireflective":true,"shadow":{"rule":"none","transmittance":1.0}},
  {"kind":"quad","name":"card","corners":[[-2.0,3.676470588235294,-2.0],[2.0,3.676470588235294,-2.0],[2.0,3.676470588235294,2.0],[-2.0,3.676470588235294,2.0]],"surface":{"kind":"coordinates"}}],
 "replicates": [
  {"output":"render_0001.exr","seed":1,"shift":[0.0,0.0]}]
}''')

main(SCENE)
