"""Templates, fits and parameters that the program refuses."""

from program_files import *  # noqa: F403
from rows import row, section

section('Templates')
row('template show stool')
row('template show missing.json')
row('template mesh stool -o r.obj')
row('template fit cube.obj --template stool --json r.json')
for title, content in (
        ('no JSON', '{'), ('no object', '[]'), ('200 brackets', '[' * 200 + ']' * 200), ('a number beyond double precision', '{"version": 1e999}'),
        ('a key twice', '{"version": 1, "version": 1}'), ('another version', template(version=2)),
        ('no name', template(name='left out')), ('a name that is a number', template(name=1)),
        ('no root', template(root='left out')),
        ('a root that is a number', template(root=1)), ('a root that is not there', template(root='top')),
        ('an unknown key', template(colour='red')), ('an unknown axis', template(up='w')),
        ('no nodes', template(nodes=[])),
        ('nodes that are no list', template(nodes={})),
        ('a parameter without bounds', template(parameters=[{'name': 'size', 'default': 2}])),
        ('a parameter of no name', parameter(name='2size')),
        ('a parameter named like a function', parameter(name='min')),
        ('a parameter twice', template(parameters=2 * [{'name': 'size', 'default': 2, 'min': 1, 'max': 4}])),
        ('a default that is a text', parameter(default='2')), ('a default that is out of bounds', parameter(default=5)),
        ('bounds that are swapped', parameter(min=4, max=1)),
        ('a node twice', template(2 * [{'id': 'root', 'type': 'sphere', 'radius': 1}])),
        ('an unknown type', template([{'id': 'root', 'type': 'spere', 'radius': 1}])),
        ('an unknown key of a node', sphere(1, rounding=0.1)),
        ('a node that nothing refers to',
         template([{'id': 'root', 'type': 'sphere', 'radius': 1}, {'id': 'idle', 'type': 'sphere', 'radius': 1}])),
        ('a node that refers to itself', template([{'id': 'root', 'type': 'shell', 'of': 'root', 'thickness': 0.1}])),
        ('257 nodes, one within the other',
         template([{'id': 'root' if i == 0 else f'n{i}', 'type': 'shell', 'of': f'n{i + 1}', 'thickness': 0.1}
                   for i in range(256)] + [{'id': 'n256', 'type': 'sphere', 'radius': 1}])),
        ('a node of a number', template([{'id': 'root', 'type': 'shell', 'of': 1, 'thickness': 0.1}])),
        ('a root that is flat', template([{'id': 'root', 'type': 'circle', 'radius': 1}])),
        ('a radius of 0', sphere(0)), ('a radius that is a list', sphere([1])),
        ('a radius that is not finite', sphere('1 / (size - 2)')),
        ('an unknown parameter', sphere('girth')), ('an expression that ends too early', sphere('size +')),
        ('an expression with a sign that is none', sphere('size ^ 2')), ('an empty expression', sphere('')),
        ('parentheses that do not close', sphere('(size')), ('101 parentheses', sphere('(' * 101 + '1' + ')' * 101)),
        ('a function of too few values', sphere('min(size)')), ('a number that is none', sphere('1e999')),
        ('a rounding below 0', template([{'id': 'root', 'type': 'box', 'size': [1, 2, 3], 'rounding': -0.1}])),
        ('a size of two numbers', template([{'id': 'root', 'type': 'box', 'size': [1, 2]}])),
        ('a polygon of a number', template([{'id': 'root', 'type': 'extrude', 'of': 'flat', 'height': 1},
                                            {'id': 'flat', 'type': 'polygon', 'corners': [1, 2, 3]}])),
        ('a body extruded', template([{'id': 'root', 'type': 'extrude', 'of': 'ball', 'height': 1},
                                      {'id': 'ball', 'type': 'sphere', 'radius': 1}])),
        ('a flat shape in a shell', template([{'id': 'root', 'type': 'shell', 'of': 'disc', 'thickness': 0.1},
                                              {'id': 'disc', 'type': 'circle', 'radius': 1}])),
        ('a flat shape lathed', template([{'id': 'root', 'type': 'twist', 'of': 'disc', 'rate': 1},
                                          {'id': 'disc', 'type': 'circle', 'radius': 1}])),
        ('a flat shape and a body together', template([{'id': 'root', 'type': 'union', 'of': ['ball', 'disc']},
                                                       {'id': 'ball', 'type': 'sphere', 'radius': 1},
                                                       {'id': 'disc', 'type': 'circle', 'radius': 1}])),
        ('a lathe of unlike lists', template([{'id': 'root', 'type': 'lathe', 'heights': [0, 1], 'radii': [1, 1, 1]}])),
        ('a bend towards its own axis',
         template([{'id': 'root', 'type': 'bend', 'of': 'ball', 'axis': 'y', 'towards': 'y', 'rate': 1},
                                                  {'id': 'ball', 'type': 'sphere', 'radius': 1}])),
        ('a shear along its own axis',
         template([{'id': 'root', 'type': 'shear', 'of': 'ball', 'axis': 'y', 'along': 'y', 'amount': 1},
                                                 {'id': 'ball', 'type': 'sphere', 'radius': 1}])),
        ('65 copies', template([{'id': 'root', 'type': 'repeat_around', 'of': 'ball', 'count': 65},
                                {'id': 'ball', 'type': 'sphere', 'radius': 1}]))):
    row('template show a.json', title, {'a.json': content})
NESTED = [{'id': f'n{i}', 'type': 'repeat_around', 'of': f'n{i + 1}', 'count': 64} for i in range(6)]
row('template show a.json', 'copies of copies',
    {'a.json': template([{**NESTED[0], 'id': 'root'}, *NESTED[1:], {'id': 'n6', 'type': 'sphere', 'radius': 1}])})
AWAY = template([{'id': 'root', 'type': 'translate', 'of': 'ball', 'by': [500, 0, 0]},
                 {'id': 'ball', 'type': 'sphere', 'radius': 'size'}])
row('template mesh a.json -o r.obj', 'a surface far away', {'a.json': AWAY})
row('template mesh a.json -o r.obj', 'a surface that does not end', {'a.json': sphere(90)})
row('template fit cube.obj --template a.json --json r.json', 'a surface far away', {'a.json': AWAY})
row('template mesh box --resolution 7 -o r.obj')

section('Parameters: --set')
EDIT = 'template edit cube.obj --fit fit.json -o r.obj '
for text in ('=1', 'width', 'width=', 'width=wide', 'width=nan', 'girth=1', 'width=5', 'depth*=9', 'width+=-3'):
    row(EDIT + f"--set '{text}'")
row(EDIT + '--set depth=1,2 width=1,2,3')
row(EDIT + '--set width*=1e300 --set width*=1e300 --beyond')
row('template mesh box --set width=1,2 -o r.obj')
row('template show box --set width=5')
row('template interpolate cube.obj --fit fit.json --set width=1,2 -o r.obj')
row('template interpolate cube.obj --fit fit.json -o r.obj')
row('template interpolate cube.obj --fit fit.json --set width=2 --frames 1 -o r.obj')

section('Fits: --fit, --to, --source-fit, --target-fit')
row('template edit cube.obj --set width=1 -o r.obj')
row('template edit cube.obj --template box --fit fit.json --up z --set width=1 -o r.obj')
row('template edit cube.obj --fit missing.json --set width=1 -o r.obj')
row('template interpolate cube.obj --fit fit.json --to missing.json -o r.obj')
row('template retarget cube.obj cube.obj --source-fit missing.json -o r.obj')
row('template retarget cube.obj cube.obj --source-fit fit.json --target-fit missing.json -o r.obj')
row('template retarget cube.obj cube.obj --source-fit fit.json --target-fit fit.json --samples 200 -o r.obj')
row('template retarget cube.obj cube.obj --source-fit fit.json --target-fit fit.json --target-up z -o r.obj')
row('template retarget cube.obj bad.obj --source-fit fit.json -o r.obj', 'a mesh without area', {'bad.obj': ON_A_LINE})
row('template fit bad.obj --template box --json r.json', 'a mesh without area', {'bad.obj': ON_A_LINE})
row('template edit cube.obj --template mug --fit fit.json --set width=1 -o r.obj')
row('template edit cube.obj --template box --fit a.json --set width=1 -o r.obj', 'of another template called box',
    {'a.json': lambda document: fit({**document, 'description': 'Another one.'})})
row('template edit cube.obj --fit a.json --set width=1 -o r.obj', 'a fit that is far too large',
    {'a.json': lambda document: fit(document, pose={**POSE, 'scale': 1e300, 'offset': [0, 0, 0]})})
POSE = {'scale': 1, 'rotation': [[1, 0, 0], [0, 1, 0], [0, 0, 1]], 'offset': [0, 0, 0]}


def broken(**more):
    """A fit of the template box, but for what is given: its document is there when rows are run."""
    return lambda document: fit(document, **more)


for title, content in (
        ('no JSON', '{\n'), ('no object', '[]'), ('200 brackets', '[' * 200 + ']' * 200), ('a key twice', '{"pose": 1, "pose": 1}'),
        ('a number beyond double precision', '{"pose": 1e999}'),
        ('no template_document', broken(template_document='left out')),
        ('a template_document that is none', broken(template_document={})),
        ('no pose', broken(pose='left out')), ('no scale', broken(pose={**POSE, 'scale': None})),
        ('a scale of 0', broken(pose={**POSE, 'scale': 0})),
        ('an offset of two numbers', broken(pose={**POSE, 'offset': [0, 0]})),
        ('an unknown key of the pose', broken(pose={**POSE, 'mirror': True})),
        ('a rotation of two rows', broken(pose={**POSE, 'rotation': [[1, 0, 0]]})),
        ('a rotation that mirrors', broken(pose={**POSE, 'rotation': [[-1, 0, 0], [0, 1, 0], [0, 0, 1]]})),
        ('no parameters', broken(parameters={})), ('a number of vertices below 0', broken(vertices=-1)),
        ('an unknown parameter', lambda document: fit(document, parameters={
            'girth': 1, **{p['name']: p['default'] for p in document['parameters']}}))):
    row('template edit cube.obj --fit a.json --set width=1 -o r.obj', title, {'a.json': content})

section('swage template')
for option in ('--samples 99', '--samples many', '--volume-samples -1', '--alpha -1', '--sigmas 0', '--least-sigma 0',
               '--fit-iterations 0',
               '--seed -1', '--up w'):
    row('template fit cube.obj --template box --json r.json ' + option)
row('template fit cube.obj --json r.json')
row('template fit cube.obj --template box --picture p.jpg')
for option in ('--tracking 0', '--smoothing 2', '--feature-angle 181', '--sub-edits -1', '--passes 0', '--tolerance 1'):
    row(EDIT + '--set width=1.5 ' + option)
