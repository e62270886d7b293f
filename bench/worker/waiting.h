#pragma once

#include <chrono>
#include <functional>
#include <string>

namespace ptb {

/// Hears what a launcher last said while it has not started a worker.
using TellWaiting = std::function<void(const std::string& words)>;

/// Tells of a wait that is no short one, and again when the launcher says something new.
class Waiting {
  public:
    explicit Waiting(TellWaiting tell) : tell_(std::move(tell)) {}
    void look(const std::string& words);

  private:
    TellWaiting tell_;
    std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
    bool told_ = false;
    std::string last_;
};

}  // namespace ptb
