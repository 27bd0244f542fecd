SCENE = json.loads(r'''{
 "name": "test",
 "unit_mm": 90.0,
 "origin_mm": [0.0,0.0,0.0],
 "camera": {"eye":[0.0,-10.0,0.0],"right":[1.0,0.0,0.0],"up":[0.0,0.0,1.0],"back":[0.0,-1.0,0.0],"width_px":256,"height_px":256,"farthest":44.0,"projection":"orthographic","width":1.6666666666666667},
 "sampling": {"filter":"BOX","samples":16,"window":false},
 "environment": [0.1,0.2,0.3],
 "lights": [],
 "objects": [
  {"kind":"quad","name":"lamp","corners":[[-1.511111111111111,2.7777777777777777,-1.511111111111111],[1.511111111111111,2.7777777777777777,-1.511111111111111],[1.511111111111111,2.7777777777777777,1.511111111111111],[-1.511111111111111,2.7777777777777777,1.511111111111111]],"surface":{"kind":"emissive","radiance":[1.0,0.5,0.0],"strength":5.0}}],
 "replicates": [
  {"output":"render_0001.exr","seed":1,"shift":[0.0,0.0]}]
}''')

main(SCENE)
