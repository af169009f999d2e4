"""What the program is given: meshes, gestures and other files, right ones and broken ones."""

import json
import struct
import zlib

CUBE = """v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
g bottom
f 1 4 3 2
g sides
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
g top
f 5 6 7 8
"""
CORNERS = 'v 0 0 0\nv 1 0 0\nv 0 1 0\n'
TRIANGLE = CORNERS + 'f 1 2 3\n'
TWO_PARTS = CUBE + 'v 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 9 11 10\nf 9 10 12\nf 10 11 12\nf 11 9 12\n'
AT_ONE_POINT = 'v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n'
ON_A_LINE = 'v 0 0 0\nv 1 0 0\nv 3 0 0\nf 1 2 3\n'

OFF_CORNERS = '0 0 0\n1 0 0\n0 1 0\n'
SOLID = 'solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n'

XYZ = 'property float x\nproperty float y\nproperty float z\n'
PLY_VERTICES = 'format ascii 1.0\nelement vertex 3\n' + XYZ
PLY_FACE = 'element face 1\nproperty list uchar int vertex_indices\n'


def ply(header, body=''):
    return f'ply\n{header}end_header\n{body}'


BINARY_PLY = ('ply\nformat binary_little_endian 1.0\nelement vertex 3\n' + XYZ + PLY_FACE + 'property int flag\n'
              'end_header\n').encode() + bytes(36) + b'\x03' + struct.pack('<3i', 0, 1, 2)


def ply_with_normals(normal='0 0 1', count=3, of='vertex'):
    names = 'property float nx\nproperty float ny\nproperty float nz\n'
    vertex = f'element vertex {count}\n' + XYZ + (names if of == 'vertex' else '')
    face = PLY_FACE + (names if of == 'face' else '')
    rows = [f'{i} {i * i} 0' + (f' {normal}' if of == 'vertex' else '') for i in range(count)]
    return ply('format ascii 1.0\n' + vertex + face,
               '\n'.join(rows) + '\n3 0 1 2' + (f' {normal}' if of == 'face' else '') + '\n')


def png(width, height, channels=3, damaged=False):
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))

    row = b'\0' + b'\x80\x80\xff'[:channels] * width
    pixels = zlib.compress(row * height) if width * height <= 1 << 20 else b''
    if damaged:
        pixels = b'no pixels'
    header = struct.pack('>IIBBBBB', width, height, 8, 2 if channels == 3 else 0, 0, 0, 0)
    return b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + chunk(b'IDAT', pixels) + chunk(b'IEND', b'')


def gestures(*displacements, label='up'):
    return json.dumps([{'label': label, 'displacements': one} for one in displacements])


UP = {'0': [0, 0, 0], '7': [0, 0, 0.1]}


def template(nodes=None, parameters=None, **more):
    """A right one, but for what is given."""
    document = {
        'version': 1, 'name': 'test',
        'parameters': [{'name': 'size', 'default': 2, 'min': 1, 'max': 4}] if parameters is None else parameters,
        'nodes': [{'id': 'root', 'type': 'sphere', 'radius': 'size'}] if nodes is None else nodes, 'root': 'root'}
    document.update(more)
    return json.dumps({key: value for key, value in document.items() if value != 'left out'})


def sphere(radius, **more):
    return template([{'id': 'root', 'type': 'sphere', 'radius': radius, **more}])


def parameter(**more):
    return template(parameters=[{'name': 'size', 'default': 2, 'min': 1, 'max': 4, **more}])


def fit(document, **more):
    """Of a template's document, at its defaults, for the cube."""
    report = {
        'command': 'template fit', 'template': document['name'], 'template_document': document, 'vertices': 8,
        'triangles': 12, 'parameters': {p['name']: p['default'] for p in document['parameters']},
        'pose': {'scale': 1, 'rotation': [[1, 0, 0], [0, 1, 0], [0, 0, 1]], 'offset': [-0.5, -0.5, -0.5]}}
    report.update(more)
    return json.dumps({key: value for key, value in report.items() if value != 'left out'})
