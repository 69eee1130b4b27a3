#pragma once

namespace depthmocap {

// How much a value is smoothed. The cutoff of the low pass is min_cutoff_hz + beta * |speed|: a value at rest is calm,
// a fast one is hardly delayed.
struct OneEuroConfig {
  double min_cutoff_hz = 1.0;         // [Hz] (> 0)
  double beta = 0.0;                  // [Hz per unit/s] (>= 0)
  double derivative_cutoff_hz = 2.0;  // [Hz] (> 0) of the speed's own low pass
};

// The One-Euro filter (Casiez, Roussel, Vogel 2012) for one value; samples may come at irregular times.
class OneEuro {
 public:
  explicit OneEuro(const OneEuroConfig& config) : config_(config) {}
  // The filtered value at `time_s` [s]; a time that does not grow replaces the sample before.
  double filter(double value, double time_s);
  // The next value starts anew.
  void reset() { started_ = false; }

 private:
  OneEuroConfig config_;
  bool started_ = false;
  double time_s_ = 0;
  double value_ = 0;  // filtered
  double raw_ = 0;
  double speed_ = 0;  // filtered
};

}  // namespace depthmocap
