// The field step: a tape of instructions, run for LANES points at a time by whoever has a place to keep its slots. On
// processors that is the first item of each group, so that slots stay in the cache.
#include "shared/lanes.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/lane_memory.h"

#if LANES == 1
#define WORKERS GROUP  // Of a group.
#else
#define WORKERS 1
#endif

// As TapeOp.
enum {
  ADD,
  SUBTRACT,
  MULTIPLY,
  DIVIDE,
  MINIMUM,
  MAXIMUM,
  ARCTANGENT,
  LESS,
  NEGATE,
  ABSOLUTE,
  ROOT,
  SINE,
  COSINE,
  EXPONENTIAL,
  FLOOR
};

/// Where a worker's slot lies, in lanes: of workers side by side one after the other.
INLINE size_t slot_place(int slot, int slots, int worker) {
  return ((size_t)(worker / WORKERS) * slots + slot) * WORKERS + worker % WORKERS;
}
#define SLOT(i) VLOAD(slot_place(i, slots, worker), values)
#define SLOPE(i) VLOAD(slot_place(i, slots, worker), slopes)
#define ADD_SLOPE(i, v) VSTORE(SLOPE(i) + (v), slot_place(i, slots, worker), slopes)

INLINE real where(mask condition, real yes, real no) {
#if LANES == 1
  return condition ? yes : no;
#else
  return select(no, yes, condition);
#endif
}
#define ALL(x) ((real)(scalar)(x))

INLINE real value_of(int op, real a, real b) {
  switch (op) {
    case ADD:
      return a + b;
    case SUBTRACT:
      return a - b;
    case MULTIPLY:
      return a * b;
    case DIVIDE:
      return a / b;
    case MINIMUM:
      return where(b < a, b, a);
    case MAXIMUM:
      return where(a < b, b, a);
    case ARCTANGENT:
      return where((a == ALL(0)) & (b == ALL(0)), ALL(0), atan2(a, b));
    case LESS:
      return where(a < b, ALL(1), ALL(0));
    case NEGATE:
      return -a;
    case ABSOLUTE:
      return fabs(a);
    case ROOT:
      return sqrt(where(a > ALL(0), a, ALL(0)));
    case SINE:
      return sin(a);
    case COSINE:
      return cos(a);
    case EXPONENTIAL:
      return exp(a);
    default:
      return floor(a);
  }
}

/// Adds to the slopes of a and b those by way of an instruction.
#define PASS_ON(to, slope) VSTORE(VLOAD(to, slopes) + (slope), to, slopes)
INLINE void pass_on(int op, size_t a_place, size_t b_place, real value, real slope, global const scalar* values,
                    global scalar* slopes) {
  const real a = VLOAD(a_place, values), b = VLOAD(b_place, values), none = ALL(0);
  switch (op) {
    case ADD:
      PASS_ON(a_place, slope);
      PASS_ON(b_place, slope);
      break;
    case SUBTRACT:
      PASS_ON(a_place, slope);
      PASS_ON(b_place, -slope);
      break;
    case MULTIPLY:
      PASS_ON(a_place, slope * b);
      PASS_ON(b_place, slope * a);
      break;
    case DIVIDE:
      PASS_ON(a_place, slope / b);
      PASS_ON(b_place, -slope * value / b);
      break;
    case MINIMUM:
      PASS_ON(a_place, where(b < a, none, slope));
      PASS_ON(b_place, where(b < a, slope, none));
      break;
    case MAXIMUM:
      PASS_ON(a_place, where(a < b, none, slope));
      PASS_ON(b_place, where(a < b, slope, none));
      break;
    case ARCTANGENT: {
      const real square = a * a + b * b;
      const real part = where(square > none, slope / square, none);
      PASS_ON(a_place, part * b);
      PASS_ON(b_place, -part * a);
      break;
    }
    case NEGATE:
      PASS_ON(a_place, -slope);
      break;
    case ABSOLUTE:
      PASS_ON(a_place, where(a < none, -slope, slope));
      break;
    case ROOT:
      PASS_ON(a_place, where(value > none, slope * ALL(0.5) / value, none));
      break;
    case SINE:
      PASS_ON(a_place, slope * cos(a));
      break;
    case COSINE:
      PASS_ON(a_place, -slope * sin(a));
      break;
    case EXPONENTIAL:
      PASS_ON(a_place, slope * value);
      break;
    default:
      break;
  }
}

/// `code`: an instruction's operation, a and b. `fixed`: parameters, constants and what is made of them, `uniforms` in
/// all. `derivatives`: 0 none, 1 by the point, 2 by parameters too: by parameter m is the sum of slopes of slots
/// uses[k] times weights[k], offsets[m] <= k < offsets[m + 1].
kernel void run_tape(const int items, const int count, const int uniforms, const int length, const int root,
                     const int derivatives, const int parameters, global const int* code, global const scalar* fixed,
                     global const int* offsets, global const int* uses, global const scalar* weights,
                     global const host_scalar* points, global scalar* values, global scalar* slopes,
                     global host_scalar* field, global host_scalar* gradients, global host_scalar* by_parameters) {
  const int place = (int)get_local_id(0);
  if (place >= WORKERS || (int)get_global_id(0) >= items) return;
  const int worker = (int)get_group_id(0) * WORKERS + place, workers = items / GROUP * WORKERS;
  const int slots = uniforms + 3 + length;
  for (int s = 0; s < uniforms; ++s) VSTORE(ALL(fixed[s]), slot_place(s, slots, worker), values);
  for (int i = worker; i * LANES < count; i += workers) {
    const lane_index own = own_elements(i, count);
    const int elements = elements_of(i, count);
    const Vec3 p = gather_host3(points, own);
    VSTORE(p.x, slot_place(uniforms, slots, worker), values);
    VSTORE(p.y, slot_place(uniforms + 1, slots, worker), values);
    VSTORE(p.z, slot_place(uniforms + 2, slots, worker), values);
    for (int s = 0; s < length; ++s) {
      const real made = value_of(code[3 * s], SLOT(code[3 * s + 1]), SLOT(code[3 * s + 2]));
      VSTORE(made, slot_place(uniforms + 3 + s, slots, worker), values);
    }
    store_host_entries(SLOT(root), field + LANES * i, 1, elements);
    if (derivatives == 0) continue;
    for (int s = 0; s < slots; ++s) VSTORE(ALL(0), slot_place(s, slots, worker), slopes);
    VSTORE(ALL(1), slot_place(root, slots, worker), slopes);
    for (int s = length - 1; s >= 0; --s) {
      const size_t made = slot_place(uniforms + 3 + s, slots, worker);
      pass_on(code[3 * s], slot_place(code[3 * s + 1], slots, worker), slot_place(code[3 * s + 2], slots, worker),
              VLOAD(made, values), VLOAD(made, slopes), values, slopes);
    }
    global host_scalar* gradient = gradients + 3 * LANES * (long)i;
    for (int axis = 0; axis < 3; ++axis) store_host_entries(SLOPE(uniforms + axis), gradient + axis, 3, elements);
    if (derivatives == 1) continue;
    global host_scalar* by = by_parameters + (long)parameters * LANES * i;
    for (int m = 0; m < parameters; ++m) {
      real sum = ALL(0);
      for (int k = offsets[m]; k < offsets[m + 1]; ++k) sum += SLOPE(uses[k]) * ALL(weights[k]);
      store_host_entries(sum, by + m, parameters, elements);
    }
  }
}
