#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace ptb::tree {

/// Threads that share tasks out among themselves. A task may add others, and need not wait for them.
class Crew {
  public:
    using Task = std::function<void()>;
    using Chunk = std::function<void(std::size_t begin, std::size_t end)>;

    /// `threads` counts the caller's, which works while it waits.
    explicit Crew(int threads);
    Crew(const Crew&) = delete;
    Crew& operator=(const Crew&) = delete;
    ~Crew();

    void add(Task task);

    /// Until all tasks are done; throws what one of them threw.
    void finish();

    /// Calls `work` for [0, count) in chunks, on this thread and those that are idle; also within a task.
    /// `work` may not throw.
    void for_chunks(std::size_t count, std::size_t chunk, const Chunk& work);

  private:
    void help();
    void run_one(std::unique_lock<std::mutex>& lock);

    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Task> waiting_;
    std::size_t unfinished_ = 0;
    std::exception_ptr error_;
    bool over_ = false;
    std::vector<std::jthread> helpers_;  ///< the last: they use the others
};

}  // namespace ptb::tree
