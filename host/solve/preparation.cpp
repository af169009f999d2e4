#include "preparation.h"

namespace swage {

Stages::Stages(const ProgressFn& progress, int pass_limit, double whole)
    : progress_(progress), now_{"", 0, pass_limit, 0, 0}, whole_(whole), poll_(sparing([this] { return goes_on(); })) {}

void Stages::begin(const char* stage, double part) {
  now_.stage = stage;
  now_.fraction = part * whole_;
  if (!goes_on()) throw Cancelled();
}

ProgressFn after_preparation(const ProgressFn& progress) {
  if (!progress) return progress;
  return [&progress](Progress p) {
    p.fraction = kPrepared + (1 - kPrepared) * p.fraction;
    return progress(p);
  };
}

}  // namespace swage
