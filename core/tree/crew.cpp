#include "core/tree/crew.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <stdexcept>
#include <utility>

namespace ptb::tree {
namespace {

/// A loop that several threads take chunks of. Whoever comes late finds none left, and touches only this.
struct Loop {
    std::size_t chunks = 0;
    std::function<void(std::size_t)> work;
    std::atomic<std::size_t> next{0}, done{0};

    void take_chunks() {
        for (std::size_t i; (i = next.fetch_add(1)) < chunks;) {
            work(i);
            if (done.fetch_add(1) + 1 == chunks) done.notify_all();
        }
    }
    void wait() const {
        for (std::size_t seen; (seen = done.load()) < chunks;) done.wait(seen);
    }
};

}  // namespace

Crew::Crew(int threads) {
    if (threads < 1)
        throw std::invalid_argument("threads " + std::to_string(threads) + ": must be 1 or more");
    for (int i = 1; i < threads; ++i) helpers_.emplace_back([this] { help(); });
}

Crew::~Crew() {
    const std::lock_guard lock(mutex_);
    over_ = true;
    changed_.notify_all();
}

void Crew::add(Task task) {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(task));
    ++unfinished_;
    changed_.notify_one();
}

/// The youngest: what it works on is still in the cache.
void Crew::run_one(std::unique_lock<std::mutex>& lock) {
    const Task task = std::move(waiting_.back());
    waiting_.pop_back();
    lock.unlock();
    std::exception_ptr error;
    try {
        task();
    } catch (...) {
        error = std::current_exception();
    }
    lock.lock();
    if (error && !error_) error_ = error;
    if (--unfinished_ == 0) changed_.notify_all();
}

void Crew::help() {
    std::unique_lock lock(mutex_);
    while (!over_) {
        if (waiting_.empty())
            changed_.wait(lock);
        else
            run_one(lock);
    }
}

void Crew::finish() {
    std::unique_lock lock(mutex_);
    while (unfinished_ > 0) {
        if (waiting_.empty())
            changed_.wait(lock);
        else
            run_one(lock);
    }
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

void Crew::for_chunks(std::size_t count, std::size_t chunk, const Chunk& work) {
    const auto loop = std::make_shared<Loop>();
    loop->chunks = (count + chunk - 1) / chunk;
    loop->work = [&work, count, chunk](std::size_t i) { work(i * chunk, std::min(count, (i + 1) * chunk)); };
    for (std::size_t i = 1; i < std::min(helpers_.size() + 1, loop->chunks); ++i)
        add([loop] { loop->take_chunks(); });
    loop->take_chunks();
    loop->wait();
}

}  // namespace ptb::tree
