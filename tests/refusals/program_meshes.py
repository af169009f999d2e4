"""Files that the program refuses: meshes, gestures, curvatures, chains, styles. What is given, and in which words."""

import struct

from program_files import *  # noqa: F403
from rows import row, section


def bad(name, *given):
    """Read by `swage info`."""
    for title, content in given:
        row(f'info {name}', title, {name: content})


section('Any mesh file')
row('info missing.obj', 'no such file')
row('info missing/a.obj', 'no such folder')
row('info folder.obj', 'a folder', {'folder.obj/cube.obj': CUBE})
row('info endless.obj', 'a device', {}, links={'endless.obj': '/dev/zero'})
row('info loop.obj', 'a link to itself', {}, links={'loop.obj': 'loop.obj'})
row('info memory.obj', 'a file whose reading fails', {}, links={'memory.obj': '/proc/self/mem'})
row('info cube.fbx', 'a format that is not read', {'cube.fbx': CUBE})
bad('a.obj', ('empty', ''), ('UTF-16', CUBE.encode('utf-16')), ('bytes of 0', CUBE.replace(' ', '\0', 1)))
for command in ('reshape {} --pin 0 --move 1=0,0,1 -o r.obj', 'stylize {} --style cube -o r.obj',
                'resize {} --scale 2,1,1 -o r.obj', 'compare {} {}', 'template fit {} --template box --json r.json'):
    row(command.replace('{}', 'missing.obj'), 'no such file')
    row(command.replace('{}', 'a.obj'), 'a coordinate that is not a number',
        {'a.obj': CUBE.replace('1 1 1', '1 nan 1')})
for command in ('reshape {} --pin 0 --move 1=0,0,1 -o r.obj', 'stylize {} --style cube -o r.obj',
                'resize {} --scale 2,1,1 -o r.obj', 'template fit {} --template box --json r.json'):
    row(command.replace('{}', 'a.obj'), 'a face of two corners', {'a.obj': CUBE + 'f 1 2\n'})
    row(command.replace('{}', 'a.obj'), 'all vertices at one point', {'a.obj': AT_ONE_POINT})

section('OBJ')
bad('a.obj', ('a face of vertex 0', CORNERS + 'f 1 2 0\n'),
    ('a face of a vertex that is not there', TRIANGLE + 'f 1 2 4\n'),
    ('a face of a vertex that is not there yet', CORNERS + 'f 1 2 -4\nv 0 0 0\n'),
    ('a face of a vertex beyond 2^31', CORNERS + 'f 1 2 2147483649\n'), ('a face of a letter', CORNERS + 'f 1 2 x\n'),
    ('a corner of four parts', CORNERS + 'f 1/2/3/4 2 3\n'), ('two coordinates', CORNERS + 'v 1 2\nf 1 2 3\n'),
    ('a coordinate that is none', CORNERS + 'v 1 2 3x\nf 1 2 3\n'), ('the file ends in a vertex', CORNERS + 'v 1 2'),
    ('a coordinate that is not a number', CORNERS + 'v 1 nan 2\nf 1 2 3\n'),
    ('a coordinate too large', CORNERS + 'v 1 -1.1e12 2\nf 1 2 3\n'),
    ('a normal of two numbers', CORNERS + 'vn 1 2\nf 1 2 3\n'),
    ('no faces', CORNERS), ('a face of 20,001 corners that is not convex',
                            ''.join(f'v {i} {i % 2} 0\n' for i in range(20001)) + 'f' +
                            ''.join(f' {i + 1}' for i in range(20001)) + '\n'))

section('OFF')
bad('a.off', ('another file', 'solid\n'), ('letters before OFF', 'XOFF\n3 1 0\n' + OFF_CORNERS + '3 0 1 2\n'),
    ('binary', 'OFF BINARY\n\x01\x02'), ('four dimensions', '4OFF\n3 1 0\n' + OFF_CORNERS),
    ('no number of faces', 'OFF\n3\n' + OFF_CORNERS), ('a number of vertices that is not whole', 'OFF\n3.5 1 0\n'),
    ('fewer than no vertices', 'OFF\n-3 1 0\n' + OFF_CORNERS),
    ('more vertices than the file holds', 'OFF\n300 6 0\n' + OFF_CORNERS),
    ('a face of a vertex that is not there', 'OFF\n3 1 0\n' + OFF_CORNERS + '3 0 1 3\n'),
    ('the file ends before the last face', 'OFF\n3 2 0\n' + OFF_CORNERS + '3 0 1 2\n'))

section('PLY')
XYZ_TWICE = PLY_VERTICES + 'property float y\n' + PLY_FACE
bad('a.ply', ('another file', 'plx\n'), ('no end_header', 'ply\nformat ascii 1.0\nelement vertex 3\n'),
    ('no format', ply('element vertex 3\n')), ('an unknown format', ply('format binary_middle_endian 1.0\n')),
    ('no faces', ply(PLY_VERTICES, OFF_CORNERS)), ('no vertices', ply('format ascii 1.0\n' + PLY_FACE)),
    ('triangle strips', ply(PLY_VERTICES + 'element tristrips 1\nproperty list int int vertex_indices\n')),
    ('no z', ply('format ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n' + PLY_FACE,
                OFF_CORNERS + '3 0 1 2\n')),
    ('a property before any element', ply('property float x\n')), ('a property twice', ply(XYZ_TWICE)),
    ('an element twice', ply(PLY_VERTICES + 'element vertex 3\n' + PLY_FACE)),
    ('an unknown type', ply(PLY_VERTICES + 'property quad q\n')), ('an unknown line', ply(PLY_VERTICES + 'nonsense\n')),
    ('a list whose length is a float', ply(PLY_VERTICES + 'element face 1\nproperty list float int vertex_indices\n')),
    ('corners that are floats',
     ply(PLY_VERTICES + 'element face 1\nproperty list uchar float vertex_indices\n', OFF_CORNERS)),
    ('a face of a vertex that is not there', ply(PLY_VERTICES + PLY_FACE, OFF_CORNERS + '3 0 1 3\n')),
    ('a coordinate that is missing', ply(PLY_VERTICES + PLY_FACE, '0 0\n1 0 0\n0 1 0\n3 0 1 2\n')),
    ('an entry that is missing',
     ply(PLY_VERTICES + 'property int flag\n' + PLY_FACE, '0 0 0\n1 0 0 1\n0 1 0 1\n3 0 1 2\n')),
    ('binary, and cut short in a face', BINARY_PLY),
    ('more faces than the file holds', ply(PLY_VERTICES + PLY_FACE, OFF_CORNERS)))

section('STL')
bad('a.stl', ('neither ascii nor binary', 'garbage'),
    ('binary, more triangles than the file holds', b' ' * 80 + struct.pack('<I', 0xffffffff)),
    ('no endsolid', SOLID + 'vertex 0 1 0\nendloop\nendfacet\n'), ('a facet of two corners', SOLID + 'endloop\n'),
    ('the file ends in a facet', SOLID), ('an unknown word', SOLID + 'vertex 0 1 0\nendloop\nendfacet\nnonsense\n'),
    ('no triangles', 'solid a\nendsolid a\n'))

section('Gestures: .deform files')
for title, content in (
        ('no such file', None), ('no JSON', '[{'), ('a number beyond double precision', '[{"label": 1e999}]'),
        ('no list', '{}'),
        ('an empty list', '[]'), ('a list of numbers', '[1]'), ('no label', '[{"displacements": {}}]'),
        ('no displacements', '[{"label": "up"}]'), ('no handles', gestures({})),
        ('a vertex that is no number', gestures({'first': [0, 0, 1]})),
        ('a vertex that is not there', gestures({'8': [0, 0, 1]})),
        ('a displacement of two numbers', gestures({'0': [0, 1]})),
        ('a displacement that is too large', gestures({'0': [0, 0, 1.7e308]})),
        ('a target beyond 1e12', gestures({'0': [0, 0, 1e13]})),
        ('a vertex twice', '[{"label": "up", "displacements": {"0": [0, 0, 0], "0": [0, 0, 1]}}]'),
        ('a label twice', gestures(UP, UP))):
    row('reshape cube.obj --gesture a.deform -o r.obj', title, {} if content is None else {'a.deform': content})
TWO = gestures(UP)[:-1] + ', ' + gestures(UP, label='down')[1:]
row('reshape cube.obj --gesture a.deform -o r.obj', 'two gestures', {'a.deform': TWO})
row('reshape cube.obj --gesture a.deform:left -o r.obj', 'a label that is not there', {'a.deform': TWO})
row('reshape cube.obj --gesture a.deform --pin 7 -o r.obj', 'a vertex of the gesture is pinned',
    {'a.deform': gestures(UP)})

section('Curvatures: .fk files')
for title, content in (('too few', '1 0\n'), ('too many', '1 0\n' * 13), ('three on a line', '1 0 2\n' * 12),
                       ('one that is not finite', '1 nan\n' * 12), ('one that is none', '1 x\n' * 12)):
    row('reshape cube.obj --pin 0 --move 1=0,0,1 --curvature a.fk -o r.obj', title, {'a.fk': content})

section('Straight chains')
for title, content in (('a vertex that is not there', '0 8\n'), ('a vertex twice', '0 0\n'), ('a word', '0 one\n'),
                       ('vertices that no edge joins', '0 6\n')):
    row('reshape cube.obj --pin 0 --move 1=0,0,1 --straight a.txt -o r.obj', title, {'a.txt': content})
row('compare cube.obj cube.obj --straight a.txt', 'a vertex that is not there', {'a.txt': '0 8\n'})

section('Normals, captures and normal maps')
STYLIZE = 'stylize cube.obj -o r.obj '
row(STYLIZE + '--capture a.obj', 'a capture that is no picture and no PLY', {'a.obj': CUBE})
row(STYLIZE + '--capture a.ply', 'a sphere without normals',
    {'a.ply': ply(PLY_VERTICES + PLY_FACE, OFF_CORNERS + '3 0 1 2\n')})
row(STYLIZE + '--capture a.ply', 'a triangle', {'a.ply': ply_with_normals()})
row(STYLIZE + '--capture a.png', 'no PNG', {'a.png': 'text'})
row(STYLIZE + '--capture a.png', 'cut short', {'a.png': png(8, 4)[:20]})
row(STYLIZE + '--capture a.png', 'cut short in its pixels', {'a.png': png(8, 4)[:45]})
row(STYLIZE + '--capture a.png', 'without its last chunk', {'a.png': png(8, 4)[:-12]})
row(STYLIZE + '--capture a.png', 'damaged', {'a.png': png(8, 4, damaged=True)})
row(STYLIZE + '--capture a.png', 'grey', {'a.png': png(8, 4, channels=1)})
row(STYLIZE + '--capture a.png', 'too large', {'a.png': png(20000, 10000)})
row(STYLIZE + '--capture a.png', 'not twice as wide as high', {'a.png': png(8, 8)})
row(STYLIZE + '--capture a.png', 'two rows', {'a.png': png(4, 2)})
row(STYLIZE + '--normals a.obj', 'normals that are no PLY', {'a.obj': CUBE})
row(STYLIZE + '--normals a.ply', 'no normals', {'a.ply': ply(PLY_VERTICES + PLY_FACE, OFF_CORNERS + '3 0 1 2\n')})
row(STYLIZE + '--normals a.ply', 'of another number of vertices', {'a.ply': ply_with_normals()})
row(STYLIZE + '--normals a.ply', 'of another number of faces', {'a.ply': ply_with_normals(of='face')})
row('stylize t.obj -o r.obj --normals a.ply', 'one that is not finite',
    {'t.obj': TRIANGLE, 'a.ply': ply_with_normals('0 nan 1')})
row(STYLIZE + '--normal-map a.png', 'a mesh without texture coordinates', {'a.png': png(8, 8)})
MAPPED = CORNERS + 'vt 0 0\nvt 1 0\nvt 0 1\n'
for title, content in (('texture coordinates that are not there', MAPPED + 'f 1/1 2/2 3/4\n'),
                       ('a corner without texture coordinates', MAPPED + 'f 1/1 2/2 3\n'),
                       ('texture coordinates number 0', MAPPED + 'f 1/1 2/2 3/0\n')):
    row('stylize t.obj -o r.obj --normal-map a.png', title, {'t.obj': content, 'a.png': png(8, 8)})
row('stylize t.ply -o r.obj --normal-map a.png', 'a mesh that is no OBJ',
    {'t.ply': ply(PLY_VERTICES + PLY_FACE, OFF_CORNERS + '3 0 1 2\n'), 'a.png': png(8, 8)})
row(STYLIZE + '--style a.obj', 'a style without area', {'a.obj': ON_A_LINE})
row(STYLIZE + '--style a.obj --target sphere', 'an open style', {'a.obj': TRIANGLE})
row(STYLIZE + '--style a.obj --target sphere', 'a style of two parts', {'a.obj': TWO_PARTS})
