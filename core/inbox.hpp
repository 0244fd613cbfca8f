// SPDX-License-Identifier: BSD-3-Clause
// Queue from other threads to one thread.
#pragma once
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

namespace fulmar::core {

template <class Item>
class Inbox {
 public:
  /// The thread that adds the first item of a batch calls `wake`.
  explicit Inbox(std::function<void()> wake) : wake_(std::move(wake)) {}
  void put(Item item) {
    const std::lock_guard lock(mutex_);
    if (!open_) return;
    items_.push_back(std::move(item));
    if (items_.size() == 1) wake_();
  }
  std::vector<Item> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(items_, {});
  }
  /// `wake` is not called after this.
  void close() {
    const std::lock_guard lock(mutex_);
    open_ = false;
    items_.clear();
  }

 private:
  std::mutex mutex_;
  std::function<void()> wake_;
  std::vector<Item> items_;
  bool open_ = true;
};

}  // namespace fulmar::core
