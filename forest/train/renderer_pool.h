#pragma once
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace depthmocap {

// Renderers that threads take and give back, so that each is made once for every thread that renders at the same time.
template <typename Renderer>
class RendererPool {
 public:
  // One that is idle; `make` makes another where none is.
  template <typename Make>
  std::unique_ptr<Renderer> take(Make&& make) {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        auto renderer = std::move(idle_.back());
        idle_.pop_back();
        return renderer;
      }
    }
    return make();
  }
  void giveBack(std::unique_ptr<Renderer> renderer) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(renderer));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Renderer>> idle_;
};

}  // namespace depthmocap
