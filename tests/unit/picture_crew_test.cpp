#include "bench/together/picture_crew.h"

#include <chrono>
#include <filesystem>
#include <latch>
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "bench/together/nameless_file.h"
#include "bench/worker/identity.h"
#include "bench/worker/process.h"
#include "bench/worker/shared_pixels.h"
#include "core/input/json.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

TEST(SharedPicture, who_came_too_late_to_make_anything_counts_in_its_efficiency) {
    SharedPicture picture;
    picture.by = {{"a:0", "A", "1", {{0, 300}}, 1.5}, {"b:0", "B", "1", {}, 0}};
    picture.part_count = 300;
    picture.wall_s = 2;
    EXPECT_DOUBLE_EQ(picture.efficiency(), 0.75) << "150 a second of the 200 of one";
    picture.idle_parts_per_s = 100;
    EXPECT_DOUBLE_EQ(picture.efficiency(), 0.5) << "of the 300 of both";
    EXPECT_DOUBLE_EQ(picture.speedup(), 0.75);
}

/// What two devices do: each makes a piece before the other makes its second, and one gives its film before
/// the other dies with its own.
struct Script {
    bool dies_with_film;
    std::latch &both_made, &one_given;
    bool has_made = false, has_given = false;
};

class ScriptedChannel : public Channel {
  public:
    ScriptedChannel(Size size, Script& script) : size_(size), script_(script) {}

    Reply request(const Request& request, const Progress&, const Stopped&) override {
        using Kind = Request::Kind;
        const bool gives = request.kind == Kind::give_film;
        if (gives && script_.dies_with_film) script_.one_given.wait();
        if ((gives && script_.dies_with_film) || (request.kind == Kind::render_parts && script_.has_given))
            return {Reply::End::crashed, {}, "killed by SIGKILL (9)", {}};
        Reply reply{Reply::End::answered, {}, "", {}};
        Response& answer = reply.response;
        if (request.kind == Kind::open) answer.facts = facts_here({});
        if (request.kind == Kind::estimate) answer.kind = Response::Kind::estimate;
        if (request.kind == Kind::share_picture) {
            answer.kind = Response::Kind::sharing;
            answer.cut = RunCut{};
            answer.part_count = size_.pixels();
            answer.ns_per_sample = 1e7;  // so that a piece is a small share
        }
        if (request.kind == Kind::render_parts) {
            answer.kind = Response::Kind::parts_done;
            answer.parts = request.parts;
            answer.seconds = 1e-3;
            if (!std::exchange(script_.has_made, true)) script_.both_made.arrive_and_wait();
        }
        if (gives) {
            if (!std::exchange(script_.has_given, true)) script_.one_given.count_down();
            answer.kind = Response::Kind::film_given;
            answer.film = FilmFacts{size_};
        }
        return reply;
    }

  private:
    Size size_;
    Script& script_;
};

DeviceInfo device_of_key(const std::string& key) {
    DeviceInfo device;
    device.key = key;
    return device;
}

TEST(PictureCrew, what_was_delivered_is_kept_when_all_devices_are_gone) {
    SharedJob job;
    job.params.kernel = "pt";
    job.params.scene = "thesis";
    job.params.size = {64, 64};
    job.params.spp = 1;
    job.devices = {device_of_key("a:0"), device_of_key("b:0")};
    std::latch both_made(2), one_given(1);
    Script gives{false, both_made, one_given}, dies{true, both_made, one_given};
    const OpenChannel open = [&](const DeviceInfo& device) -> std::unique_ptr<Channel> {
        return std::make_unique<ScriptedChannel>(job.params.size, device.key == "a:0" ? gives : dies);
    };
    PictureCrew crew(job, open, [] { return false; });
    const SharedPicture picture = crew.make({{0, crew.part_count()}}, [](double) {});
    EXPECT_EQ(picture.failure, "a:0: killed by SIGKILL (9)");
    EXPECT_TRUE(picture.sums);
    EXPECT_FALSE(picture.whole());
    EXPECT_GT(picture.by.at(0).count(), 0u);
    EXPECT_EQ(picture.by.at(1).count(), 0u);
}

TEST(NamelessFile, is_written_by_another_process_and_is_in_no_folder) {
    const fs::path temporary = fs::temp_directory_path();
    for (const std::vector<fs::path>& folders : {places_for_films(), {"/nowhere", temporary}}) {
        const NamelessFile file(5, folders);
        EXPECT_EQ(fs::file_size(file.path()), 5u);
        WorkerProcess other({{"/bin/sh", "-c", "echo film >" + file.path().string() + "; echo written"}, {}});
        std::string line;
        ASSERT_EQ(other.read_line(line, std::chrono::seconds(60)), ReadStatus::line);
        EXPECT_EQ(read_text(file.path()), "film\n");
        EXPECT_FALSE(fs::exists(fs::read_symlink(file.path())));
    }
    EXPECT_THROW(NamelessFile(~std::uint64_t{0}, {temporary}), std::runtime_error) << "no room";
}

TEST(SharedPixels, are_those_of_the_file_and_none_of_a_file_of_another_size) {
    const Size size{3, 5};
    const NamelessFile file(SharedPixels::bytes(size));
    const SharedPixels here(file.path(), size), there(file.path(), size);
    ASSERT_EQ(here.all().size(), size.pixels());
    here.all().back().samples = 7;
    EXPECT_EQ(there.all().back().samples, 7u);
    EXPECT_THROW(SharedPixels(file.path(), {3, 6}), std::runtime_error);
    EXPECT_THROW(SharedPixels("/nowhere", size), std::runtime_error);
}

}  // namespace
}  // namespace ptb
