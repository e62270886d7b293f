#pragma once

#include <chrono>

#include "bench/cli/options.h"
#include "bench/cli/tell.h"

namespace ptb {

inline constexpr std::chrono::minutes longest_silence(10);  ///< compilers may take their time

MeasureOptions render_options(const RenderFlags& flags, const CommonFlags& common);

/// Shows the share that is done on a terminal, while it lives.
class ShareDone {
  public:
    explicit ShareDone(bool quiet) : live_(!quiet && is_live(stderr)) {}
    ~ShareDone() {
        if (live_) put(stderr, "\r\033[K");
    }
    ShareDone(const ShareDone&) = delete;
    ShareDone& operator=(const ShareDone&) = delete;
    void show(double done) const;

  private:
    bool live_;
};

}  // namespace ptb
