"""Command lines that the program refuses, and outputs that it cannot write."""

from program_files import *  # noqa: F403
from rows import row, section

EDITS = {
    'reshape': 'reshape cube.obj --pin 0 --move 7=0,0,0.1', 'stylize': 'stylize cube.obj --style cube',
    'resize': 'resize cube.obj --scale 2,1,1', 'template edit': 'template edit cube.obj --fit fit.json --set width=1.5',
    'template interpolate': 'template interpolate cube.obj --fit fit.json --set width=1.5',
    'template retarget': 'template retarget cube.obj cube.obj --source-fit fit.json',
    'template mesh': 'template mesh box'}

section('Any command')
row('fold cube.obj')
row('--sideways')
for command in ('reshape', 'stylize', 'resize', 'info', 'compare', 'compare cube.obj', 'template fit', 'template show',
                'template mesh', 'template edit', 'template retarget cube.obj', 'template interpolate'):
    row(command)
for command in ('reshape cube.obj', 'stylize cube.obj', 'resize cube.obj', 'info cube.obj', 'compare cube.obj cube.obj',
                'devices', 'demo out', 'template list', 'template show box', 'template mesh box',
                'template fit cube.obj',
                'template edit cube.obj', 'template retarget cube.obj cube.obj', 'template interpolate cube.obj'):
    row(command + ' --sideways')
row('template')
row('reshape cube.obj cube.obj --pin 0 -o r.obj')
row('info cube.obj --json')
row('info cube.obj --quiet -v')
for threads in ('0', '1025', 'two', '1.5'):
    row(f'info cube.obj --threads {threads}')

section('Backends and devices')
RESHAPE = EDITS['reshape'] + ' -o r.obj'
row(RESHAPE + ' --backend abacus')
row(RESHAPE, 'SWAGE_BACKEND is abacus', environment={'SWAGE_BACKEND': 'abacus'})
row(RESHAPE + ' --backend cpu --device 0')
row(RESHAPE + ' --backend cpu --precision single')
row(RESHAPE + ' --precision half')
row(RESHAPE + ' --backend opencl --device abacus')

section('Where results go')
row(EDITS['reshape'], 'nothing to write')
for name in ('stylize', 'resize', 'template edit', 'template interpolate', 'template retarget', 'template mesh'):
    row(EDITS[name], 'nothing to write')
for edit in EDITS.values():
    row(edit + ' -o r.fbx', 'a format that is not written')
    row(edit + ' -o missing/r.obj', 'no such folder')
    row(edit + ' --json missing/r.json', 'no such folder')
for command in ('info cube.obj', 'compare cube.obj cube.obj', 'template fit cube.obj --template box', 'devices',
                'template show box', 'template list'):
    row(command + ' --json missing/r.json', 'no such folder')
row(EDITS['reshape'] + ' -o -  --json -')
row(RESHAPE + ' --json r.obj')
row(EDITS['reshape'] + ' -o folder.obj', 'a folder', {'folder.obj/cube.obj': CUBE})
row('resize cube.obj --scale 2,1,1 --scale 3,1,1 -o -')
row('template edit cube.obj --fit fit.json --set width=1,2 -o -')
row('template interpolate cube.obj --fit fit.json --set width=2 -o -')
row('template edit cube.obj --fit fit.json --set width=1.5 -o r.obj --json fit.json')
for edit in ('reshape', 'stylize', 'resize', 'template edit', 'template mesh'):
    row(EDITS[edit] + ' -o full.obj', 'a device that is full', links={'full.obj': '/dev/full'})
    row(EDITS[edit] + ' -o - --quiet', 'stdout is full', stdout='/dev/full')
row('info cube.obj --json -', 'stdout is full', stdout='/dev/full')
row('compare cube.obj cube.obj', 'stdout is full', stdout='/dev/full')
row('devices', 'stdout is full', stdout='/dev/full')
row('template list', 'stdout is full', stdout='/dev/full')
row(RESHAPE, 'the result is a link to itself', links={'r.obj': 'r.obj'})
row('demo cube.obj', 'a file where the folder would be')
row('demo cube.obj/out', 'a file where a folder would be')

section('Pictures')
PICTURE = EDITS['stylize'] + ' --picture '
row(PICTURE + 'p.jpg')
row(PICTURE + 'missing/p.png', 'no such folder')
row(PICTURE + 'p.png --size 10x10')
row(PICTURE + 'p.png --size large')
row(PICTURE + 'p.png --view 1,2')
row(PICTURE + 'p.png --view 0,0,0')
row(PICTURE + 'p.png --up w')
row(PICTURE + 'p.png --heat warm')
row(PICTURE + 'full.png', 'a device that is full', links={'full.png': '/dev/full'})
row('compare cube.obj cube.obj --view 1,0,0')
row('resize cube.obj --scale 2,1,1 -o r.obj --up z')
row(EDITS['stylize'] + ' -o r.obj --up z')
row('template edit cube.obj --fit fit.json --set width=2 -o r.obj --view 1,0,0')

section('Selections: --pin, --move')
row('reshape cube.obj -o r.obj')
for pin in ('0,,1', '1.5', '3-1', '1-2-3', 'w<3', 'x=3', 'x<high', '@', 'box:1,2,3', 'box:0,0,0,1,1,up', 'group:',
            'component:', 'component:one', '0 &'):
    row(f"reshape cube.obj --pin '{pin}' -o r.obj")
for pin in ('8', 'x>5', 'component:2', 'group:lid', '@missing.txt', '0 & 1'):
    row(f"reshape cube.obj --pin '{pin}' -o r.obj")
row('reshape t.obj --pin group:lid -o r.obj', 'a mesh without groups', {'t.obj': TRIANGLE})
row('reshape cube.obj --pin @ids.txt -o r.obj', 'a file of a vertex that is not there', {'ids.txt': '0\n9\n'})
row('reshape cube.obj --pin @ids.txt -o r.obj', 'a file of words', {'ids.txt': 'zero\n'})
for move in ('3', '3=1,2', '3=1,2,up', '3=1,2,inf', 'z>=5'):
    row(f"reshape cube.obj --move '{move}' -o r.obj")
row('reshape cube.obj --pin 7 --move 7=0,0,1 -o r.obj')
row('reshape cube.obj --gesture missing.deform:up -o r.obj')

section('swage reshape')
for option in ('--method laplace', '--solver quick', '--linear-solver none', '--feature-angle nan',
               '--feature-angle 181',
               '--remesh often', '--scaffold often', '--handle-weight 1', '--handle-weight -1 --method arap',
               '--solver published --remesh always', '--solver published --linear-solver multigrid',
               '--straight-angle 100',
               '--straight none --straight-angle 100', '--straight auto --straight-angle 181', '--straight missing.txt',
               '--curvature missing.fk', '--scaffold-mesh t.mesh', '--scaffold-mesh t.obj'):
    row(RESHAPE + ' ' + option)
for option in ('--solver published', '--linear-solver factor', '--curvature c.fk', '--straight auto',
               '--feature-angle 90',
               '--no-finalise', '--remesh always', '--scaffold-mesh t.mesh'):
    row(RESHAPE + ' --method arap ' + option)
row(RESHAPE + ' --scaffold-mesh missing/t.vtk', 'no such folder')
row('reshape two.obj --pin 0 --move 7=0,0,0.1 --scaffold always --scaffold-mesh full.vtk -o r.obj',
    'a device that is full',
    {'two.obj': TWO_PARTS}, links={'full.vtk': '/dev/full'})

section('swage stylize')
for option in ('', '--style sphere', '--style prism2', '--style missing.obj', '--style cube --capture c.png',
               '--target closest',
               '--style cube --target nearest', '--style cube --dynamic --no-dynamic',
               '--style cube --target sphere --no-dynamic',
               '--style rounded-cube --dynamic', '--capture missing.png',
               '--capture c.ply --capture-layout hemispheres',
               '--capture c.png --capture-layout round', '--normals missing.ply', '--normal-map missing.png',
               '--normal-map n.png --normal-space world', '--normal-map n.png --normal-space object --green down',
               '--developable --tau -1', '--developable --tau 1 --threshold 1', '--tau 1', '--style cube --lambda -1',
               '--style cube --energy bend', '--style cube --weights none',
               '--style cube --energy farap --weights intrinsic',
               '--style cube --accelerate --published', '--style cube --iterations 0'):
    row('stylize cube.obj ' + option + ' -o r.obj')
for option in ('--capture c.png', '--normals n.ply', '--normal-map n.png', '--developable',
               '--target sphere --style cube',
               '--no-dynamic --style cube', '--energy arap', '--weights clamped', '--accelerate', '--published'):
    row('stylize cube.obj --polycube ' + option + ' -o r.obj')
row('stylize cube.obj --polycube --style-sheet s.png')
row('stylize cube.obj --style-sheet s.jpg')
row('stylize cube.obj --style-sheet s.png -o r.obj')

section('swage resize')
for option in ('', '--scale 2,1', '--scale 1,0,1', '--scale 1,nan,1', '--scale 1,2e6,1', '--size 1,1', '--size 1,2,-3',
               '--scale 2,1,1 --size 1,1,1', '--size 1e8,-,-', '--scale 2,1,1 --keep-weight 2',
               '--scale 2,1,1 --keep colour',
               '--scale 2,1,1 --keep size --keep-weight 0', '--scale 2,1,1 --anchor middle',
               '--scale 2,1,1 --anchor low,high',
               '--scale 2,1,1 --grid 4', '--scale 2,1,1 --grid many', '--scale 2,1,1 --grid 0,5,5',
               '--scale 2,1,1 --grid 5,5.5,5',
               '--scale 2,1,1 --grid 1000,1000,1000', '--scale 2,1,1 --crease-angle 181'):
    row('resize cube.obj ' + option + ' -o r.obj')
row('resize flat.obj --size -,-,2 -o r.obj', 'a flat mesh', {'flat.obj': TRIANGLE})
row('resize cube.obj --grid-after g.ply')
row('resize cube.obj --picture p.png')
row('resize cube.obj --vulnerability v.obj')
row('resize cube.obj --grid-before missing/g.ply', 'no such folder')
row('resize cube.obj --vulnerability v.ply --grid-before v.ply')
row('resize cube.obj --vulnerability full.ply', 'a device that is full', links={'full.ply': '/dev/full'})
for protect in ('', 'w<3', '0-7:w', 'component:', '0-7=2', '0-7:x=-0.1', 'component:2', 'group:lid:x=0.5', 'x>5',
                'box:5,5,5,6,6,6:x',
                '0,1', '@missing.txt'):
    row(f"resize cube.obj --scale 2,1,1 -o r.obj --protect '{protect}'")
row("resize cube.obj --scale 2,1,1 -o r.obj --release '0-7=1'")
row("resize named.obj --scale 2,1,1 -o r.obj --protect 'group:top:x=0.5'", 'groups top and top:x',
    {'named.obj': CUBE.replace('g bottom', 'g top:x')})

section('swage info and swage compare')
row('info cube.obj --straight -')
row('info cube.obj --straight s.txt --json s.txt')
row('info cube.obj --straight missing/s.txt', 'no such folder')
row('info cube.obj --straight-angle 100')
row('compare cube.obj t.obj', 'another number of vertices', {'t.obj': TRIANGLE})
row('compare cube.obj empty', 'a folder without meshes', {'empty/notes.txt': 'none'})
row('compare p.obj p.obj', 'all vertices at one point', {'p.obj': AT_ONE_POINT})
row('compare cube.obj cube.obj cube.obj --faces f.ply')
row('compare cube.obj cube.obj --faces f.obj')
row('compare cube.obj cube.obj --faces missing/f.ply', 'no such folder')
row('compare cube.obj cube.obj --crease-angle 181')
row('compare cube.obj cube.obj --heat warm --picture p.png')
row('compare cube.obj cube.obj --straight none --straight-angle 100')
row('compare cube.obj cube.obj --gesture missing.deform')
row('compare cube.obj cube.obj --pin 9')

section('Interrupted')
for command in ('info {}', 'reshape {} --pin 0 --move 7=0,0,0.1 -o r.obj', 'stylize {} --style cube -o r.obj',
                'resize {} --scale 2,1,1 -o r.obj', 'compare {} cube.obj',
                'template fit {} --template box --json r.json',
                'template edit {} --fit fit.json --set width=1.5 -o r.obj',
                'template retarget {} cube.obj --source-fit fit.json --target-fit fit.json -o r.obj'):
    row(command.replace('{}', 'pipe.obj'), 'SIGINT while a pipe is read', interrupted=True)
