#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <iosfwd>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace ptb {

/// The lines that a coordinator sends to this process, read by a thread of its own. Where they end while a
/// line is being answered, so does the process, at once: nobody wants the answer, and its driver may hang.
class RequestLines {
  public:
    explicit RequestLines(std::istream& in);
    RequestLines(const RequestLines&) = delete;
    RequestLines& operator=(const RequestLines&) = delete;

    /// Waits for the next line, `stop` left out; nothing when they have ended. Until it is asked for, the
    /// first line counts as being answered.
    std::optional<std::string> next();

    /// Whether a `stop` for the request of this number has come.
    bool is_stopped(std::int64_t number) const;

  private:
    void read(std::istream& in);
    void take(std::string line);
    void finish();

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::string> lines_;
    std::int64_t stopped_ = 0;
    bool is_idle_ = false, is_ended_ = false;
    std::jthread reader_;  ///< the last: it uses the others
};

}  // namespace ptb
