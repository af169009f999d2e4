// The field step: a tape of instructions, each run for BLOCK times LANES points at a time, by whoever has a place to
// keep its slots. On processors that is the first item of each group, so that slots stay in the cache.
#include "shared/lanes.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/lane_memory.h"

#if LANES == 1
#define WORKERS GROUP  // Of a group.
#define BLOCK 1        // Times LANES points that an instruction is run for at once.
#else
#define WORKERS 1
#define BLOCK 4
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
INLINE long slot_place(int slot, int slots, int worker) {
  return (((long)(worker / WORKERS) * slots + slot) * WORKERS + worker % WORKERS) * BLOCK;
}

INLINE real where(mask condition, real yes, real no) {
#if LANES == 1
  return condition ? yes : no;
#else
  return select(no, yes, condition);
#endif
}
#define ALL(x) ((real)(scalar)(x))

/// Makes the values of an instruction, of a and b where it has two.
#define EACH for (int k = 0; k < BLOCK; ++k)
#define A VLOAD(a_place + k, values)
#define B VLOAD(b_place + k, values)
#define MAKE(value) EACH VSTORE(value, to + k, values)
INLINE void make(int op, long a_place, long b_place, long to, global scalar* values) {
  switch (op) {
    case ADD:
      MAKE(A + B);
      break;
    case SUBTRACT:
      MAKE(A - B);
      break;
    case MULTIPLY:
      MAKE(A * B);
      break;
    case DIVIDE:
      MAKE(A / B);
      break;
    case MINIMUM:
      MAKE(where(B < A, B, A));
      break;
    case MAXIMUM:
      MAKE(where(A < B, B, A));
      break;
    case ARCTANGENT:
      MAKE(where((A == ALL(0)) & (B == ALL(0)), ALL(0), atan2(A, B)));
      break;
    case LESS:
      MAKE(where(A < B, ALL(1), ALL(0)));
      break;
    case NEGATE:
      MAKE(-A);
      break;
    case ABSOLUTE:
      MAKE(fabs(A));
      break;
    case ROOT:
      MAKE(sqrt(where(A > ALL(0), A, ALL(0))));
      break;
    case SINE:
      MAKE(sin(A));
      break;
    case COSINE:
      MAKE(cos(A));
      break;
    case EXPONENTIAL:
      MAKE(exp(A));
      break;
    default:
      MAKE(floor(A));
      break;
  }
}

/// Adds to the slopes of a and b those by way of an instruction.
#define VALUE VLOAD(made + k, values)
#define SLOPE VLOAD(made + k, slopes)
#define PASS_ON(to, slope) EACH VSTORE(VLOAD(to##_place + k, slopes) + (slope), to##_place + k, slopes)
INLINE void pass_on(int op, long a_place, long b_place, long made, global const scalar* values, global scalar* slopes) {
  switch (op) {
    case ADD:
      PASS_ON(a, SLOPE);
      PASS_ON(b, SLOPE);
      break;
    case SUBTRACT:
      PASS_ON(a, SLOPE);
      PASS_ON(b, -SLOPE);
      break;
    case MULTIPLY:
      PASS_ON(a, SLOPE * B);
      PASS_ON(b, SLOPE * A);
      break;
    case DIVIDE:
      PASS_ON(a, SLOPE / B);
      PASS_ON(b, -SLOPE * VALUE / B);
      break;
    case MINIMUM:
      PASS_ON(a, where(B < A, ALL(0), SLOPE));
      PASS_ON(b, where(B < A, SLOPE, ALL(0)));
      break;
    case MAXIMUM:
      PASS_ON(a, where(A < B, ALL(0), SLOPE));
      PASS_ON(b, where(A < B, SLOPE, ALL(0)));
      break;
    case ARCTANGENT:
      EACH {
        const real square = A * A + B * B;
        const real part = where(square > ALL(0), SLOPE / square, ALL(0));
        const real by_a = part * B, by_b = -part * A;
        VSTORE(VLOAD(a_place + k, slopes) + by_a, a_place + k, slopes);
        VSTORE(VLOAD(b_place + k, slopes) + by_b, b_place + k, slopes);
      }
      break;
    case NEGATE:
      PASS_ON(a, -SLOPE);
      break;
    case ABSOLUTE:
      PASS_ON(a, where(A < ALL(0), -SLOPE, SLOPE));
      break;
    case ROOT:
      PASS_ON(a, where(VALUE > ALL(0), SLOPE * ALL(0.5) / VALUE, ALL(0)));
      break;
    case SINE:
      PASS_ON(a, SLOPE * cos(A));
      break;
    case COSINE:
      PASS_ON(a, -SLOPE * sin(A));
      break;
    case EXPONENTIAL:
      PASS_ON(a, SLOPE * VALUE);
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
  const int local_place = (int)get_local_id(0);
  if (local_place >= WORKERS || (int)get_global_id(0) >= items) return;
  const int worker = (int)get_group_id(0) * WORKERS + local_place, workers = items / GROUP * WORKERS;
  const int slots = uniforms + 3 + length, last = (count - 1) / LANES;
#define PLACE(slot) slot_place(slot, slots, worker)
  for (int s = 0; s < uniforms; ++s) {
    EACH VSTORE(ALL(fixed[s]), PLACE(s) + k, values);
  }
  for (int first = worker * BLOCK; first <= last; first += workers * BLOCK) {
    EACH {
      const Vec3 p = gather_host3(points, own_elements(min(first + k, last), count));
      VSTORE(p.x, PLACE(uniforms) + k, values);
      VSTORE(p.y, PLACE(uniforms + 1) + k, values);
      VSTORE(p.z, PLACE(uniforms + 2) + k, values);
    }
    for (int s = 0; s < length; ++s) {
      make(code[3 * s], PLACE(code[3 * s + 1]), PLACE(code[3 * s + 2]), PLACE(uniforms + 3 + s), values);
    }
    const int blocks = min(BLOCK, last + 1 - first);
    for (int k = 0; k < blocks; ++k) {
      const int i = first + k;
      store_host_entries(VLOAD(PLACE(root) + k, values), field + LANES * i, 1, elements_of(i, count));
    }
    if (derivatives == 0) continue;
    for (int s = 0; s < slots; ++s) {
      EACH VSTORE(ALL(0), PLACE(s) + k, slopes);
    }
    EACH VSTORE(ALL(1), PLACE(root) + k, slopes);
    for (int s = length - 1; s >= 0; --s) {
      pass_on(code[3 * s], PLACE(code[3 * s + 1]), PLACE(code[3 * s + 2]), PLACE(uniforms + 3 + s), values, slopes);
    }
    for (int k = 0; k < blocks; ++k) {
      const int i = first + k, elements = elements_of(i, count);
      global host_scalar* gradient = gradients + 3 * LANES * (long)i;
      for (int axis = 0; axis < 3; ++axis) {
        store_host_entries(VLOAD(PLACE(uniforms + axis) + k, slopes), gradient + axis, 3, elements);
      }
      if (derivatives == 1) continue;
      global host_scalar* by = by_parameters + (long)parameters * LANES * i;
      for (int m = 0; m < parameters; ++m) {
        real sum = ALL(0);
        for (int n = offsets[m]; n < offsets[m + 1]; ++n) {
          sum += VLOAD(PLACE(uses[n]) + k, slopes) * ALL(weights[n]);
        }
        store_host_entries(sum, by + m, parameters, elements);
      }
    }
  }
}
