#pragma once

#include <future>
#include <optional>
#include <string>
#include <utility>

#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>

#include "bench/together/nameless_file.h"
#include "bench/worker/device_worker.h"
#include "bench/worker/shared_pixels.h"

namespace ptb {

/// Where a worker puts its film.
struct FilmRoom {
    explicit FilmRoom(Size size) : file(SharedPixels::bytes(size)), pixels(file.path(), size) {}

    NamelessFile file;
    SharedPixels pixels;
};

/// One device of a crew. What talks to its worker runs in its own thread, which no worker outlives.
struct CrewMember {
    CrewMember(const DeviceInfo& its_device, const OpenChannel& open, const MeasureOptions& measure)
        : device(its_device), worker(its_device, open, measure) {}
    ~CrewMember() {
        start([this] { worker.close(); }).wait();
    }
    CrewMember(const CrewMember&) = delete;
    CrewMember& operator=(const CrewMember&) = delete;

    template <class Work>
    std::future<void> start(Work&& work) {
        std::packaged_task<void()> task(std::forward<Work>(work));
        auto done = task.get_future();
        boost::asio::post(thread, std::move(task));
        return done;
    }

    DeviceInfo device;
    DeviceWorker worker;
    std::optional<FilmRoom> film;
    int workers_left = 2;     ///< that may be started: one may die
    std::string gone{};       ///< why it makes nothing any more
    bool is_sharing = false;  ///< its worker knows the picture
    double ns_per_sample = 0;
    double kept_s = 0, busy_s = 0;           ///< making what it did not, and did deliver
    double kept_device_s = 0, device_s = 0;  ///< by its own clock
    boost::asio::thread_pool thread{1};
};

}  // namespace ptb
