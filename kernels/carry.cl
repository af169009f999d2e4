// The carry step. One item one triangle or vertex, in numbers as wide as those the host shows.
typedef host_scalar real;
#include "shared/vec3.h"
#include "shared/slippage.h"
#include "shared/cells.h"

/// `residues`: what rounding took from positions that are not the host's own.
static inline real number_at(global const host_scalar* positions, global const scalar* residues, int at, real from) {
  const real off = positions[at] - from;
  return HOST_IS_EXACT ? off : off + (real)residues[at];
}
static inline real gap(global const host_scalar* positions, global const scalar* residues, int from, int to) {
  const real off = positions[to] - positions[from];
  return HOST_IS_EXACT ? off : off + (real)(residues[to] - residues[from]);
}
static inline Vec3 side_between(global const host_scalar* positions, global const scalar* residues, int from, int to) {
  return vec3(gap(positions, residues, 3 * from, 3 * to), gap(positions, residues, 3 * from + 1, 3 * to + 1),
              gap(positions, residues, 3 * from + 2, 3 * to + 2));
}
static inline Vec3 normal_of(global const int* corners, global const host_scalar* positions,
                             global const scalar* residues, real least_height) {
  return certain_normal(side_between(positions, residues, corners[0], corners[1]),
                        side_between(positions, residues, corners[1], corners[2]), least_height);
}
static inline int end_of(int side) { return side % 3 == 2 ? side - 2 : side + 1; }

/// Of triangles from `first` on.
kernel void mean_slippages(const int count, const int first, const int most_beside, const host_scalar least_height,
                           global const int* triangles, global const int* next_sides,
                           global const host_scalar* positions, global const scalar* residues,
                           global host_scalar* means) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const Vec3 normal = normal_of(triangles + 3 * (first + i), positions, residues, least_height);
  Slippage slippage = no_slippage();
  for (int own = 3 * (first + i); own < 3 * (first + i + 1); ++own) {
    const int from = triangles[own], to = triangles[end_of(own)];
    const Vec3 along = side_between(positions, residues, from, to);
    const real length = dot3(normal, normal) > (real)0 ? sqrt(dot3(along, along)) : (real)0;
    slippage = add_normal(slippage, length, normal);
    int side = next_sides[own];
    for (int seen = 0; side != own && seen < most_beside; side = next_sides[side], ++seen) {
      const Vec3 other = normal_of(triangles + side / 3 * 3, positions, residues, least_height);
      const int same_way = triangles[side] == from && triangles[end_of(side)] == to;
      const real cosine = same_way ? -dot3(normal, other) : dot3(normal, other);
      slippage = add_normal(slippage, length * more_of(cosine, (real)0), other);
    }
  }
  const Vec3 mean = mean_slippage(slippage);
  means[3 * i] = mean.x;
  means[3 * i + 1] = mean.y;
  means[3 * i + 2] = mean.z;
}

/// A grid: along each axis three numbers, where its corner is, its cells by length, 0 where it has no extent, and the
/// place of the corner.
static inline real place(global const host_scalar* grid, int axis, global const host_scalar* positions,
                         global const scalar* residues, int vertex) {
  return number_at(positions, residues, 3 * vertex + axis, grid[3 * axis]) * grid[3 * axis + 1] + grid[3 * axis + 2];
}
static inline Vec3 places_of(global const host_scalar* grid, int axis, global const int* corners,
                             global const host_scalar* positions, global const scalar* residues) {
  return vec3(place(grid, axis, positions, residues, corners[0]), place(grid, axis, positions, residues, corners[1]),
              place(grid, axis, positions, residues, corners[2]));
}
static inline int cell_at(real place, int count) {
  return (int)less_of(more_of(floor(place), (real)0), (real)(count - 1));
}
/// Of the cells along an axis, `count` in all, from the first to the last that the places reach.
static inline Cells reached(Vec3 places, real margin, int count) {
  const Range r = widened(range_of(places), margin);
  Cells cells;
  cells.first = cell_at(r.low, count);
  cells.last = cell_at(r.high, count);
  return cells;
}
static inline int inside(Range r, int from, int to) { return r.low >= (real)from && r.high < (real)to; }
static inline Vec3 less3(Vec3 places, int by) { return sub3(places, vec3((real)by, (real)by, (real)by)); }

/// How many cells the triangle touches; which, where it `lists`.
static int touched(global const int* corners, const int nx, const int ny, const int nz, const real margin,
                   global const host_scalar* grid, global const host_scalar* positions, global const scalar* residues,
                   const int lists, global int* cells) {
  Places p;
  p.x = places_of(grid, 0, corners, positions, residues);
  p.y = places_of(grid, 1, corners, positions, residues);
  p.z = places_of(grid, 2, corners, positions, residues);
  const Cells x = reached(p.x, margin, nx), y = reached(p.y, margin, ny), z = reached(p.z, margin, nz);
  // Most triangles of fine meshes lie within one cell.
  if (inside(range_of(p.x), x.first, x.first + 1) && inside(range_of(p.y), y.first, y.first + 1) &&
      inside(range_of(p.z), z.first, z.first + 1) && x.first == x.last && y.first == y.last && z.first == z.last) {
    if (lists) cells[0] = x.first + nx * (y.first + ny * z.first);
    return 1;
  }
  // From the first cell: large places would take digits from small ones.
  p.x = less3(p.x, x.first);
  p.y = less3(p.y, y.first);
  p.z = less3(p.z, z.first);
  const real radius = (real)0.5 + margin;
  int count = 0;
  for (int k = 0; k <= z.last - z.first; ++k) {
    const real at_z = (real)k + (real)0.5;
    const Cells rows = cells_in(rows_at(p, at_z, radius), y.last - y.first + 1);
    for (int j = rows.first; j <= rows.last; ++j) {
      const Cells row = cells_in(cubes_at(p, (real)j + (real)0.5, at_z, radius), x.last - x.first + 1);
      const int before = x.first + nx * (y.first + j + ny * (z.first + k));
      for (int c = row.first; c <= row.last && lists; ++c) cells[count + c - row.first] = before + c;
      count += max(row.last - row.first + 1, 0);
    }
  }
  return count;
}

/// Of triangles from `first` on: counts; or, where it `lists`, the cells, those of triangle `first` + i from numbers[i]
/// on.
kernel void touch_cells(const int count, const int first, const int nx, const int ny, const int nz,
                        const host_scalar margin, global const host_scalar* grid, global const int* triangles,
                        global const host_scalar* positions, global const scalar* residues, const int lists,
                        global int* numbers, global int* cells) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const int found = touched(triangles + 3 * (first + i), nx, ny, nz, margin, grid, positions, residues, lists,
                            lists ? cells + numbers[i] : cells);
  if (!lists) numbers[i] = found;
}

static inline Vec3 vertex_at(global const host_scalar* vertices, int at) {
  return vec3(vertices[3 * at], vertices[3 * at + 1], vertices[3 * at + 2]);
}

/// From the grid, along an axis in which it has no extent.
static inline real distance_off(global const host_scalar* grid, int axis, global const host_scalar* positions,
                                global const scalar* residues, int vertex) {
  if (grid[3 * axis + 1] > (real)0) return (real)0;
  return number_at(positions, residues, 3 * vertex + axis, grid[3 * axis]);
}

/// `vertices`: of the grid.
kernel void carry_vertices(const int count, const int nx, const int ny, const int nz, global const host_scalar* grid,
                           global const host_scalar* vertices, global const host_scalar* positions,
                           global const scalar* residues, global host_scalar* carried) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const real x = place(grid, 0, positions, residues, i), y = place(grid, 1, positions, residues, i);
  const real z = place(grid, 2, positions, residues, i);
  const int at_x = cell_at(x, nx), at_y = cell_at(y, ny), at_z = cell_at(z, nz);
  const int row = nx + 1, layer = row * (ny + 1), first = at_x + row * at_y + layer * at_z;
  Vec3 edges[4];
  for (int e = 0; e < 4; ++e) {
    const int at = first + (e & 1) * row + (e >> 1) * layer;
    edges[e] = blend3(x - (real)at_x, vertex_at(vertices, at), vertex_at(vertices, at + 1));
  }
  const Vec3 low = blend3(y - (real)at_y, edges[0], edges[1]), high = blend3(y - (real)at_y, edges[2], edges[3]);
  const Vec3 to = blend3(z - (real)at_z, low, high);
  carried[3 * i] = to.x + distance_off(grid, 0, positions, residues, i);
  carried[3 * i + 1] = to.y + distance_off(grid, 1, positions, residues, i);
  carried[3 * i + 2] = to.z + distance_off(grid, 2, positions, residues, i);
}
