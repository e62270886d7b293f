#include "bench/together/picture_crew.h"

#include <chrono>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "bench/together/nameless_file.h"
#include "bench/worker/process.h"
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

TEST(NamelessFile, is_written_by_another_process_and_is_in_no_folder) {
    for (const std::uint64_t room_bytes :
         {std::uint64_t{1}, ~std::uint64_t{0}}) {  // in memory, and where there is none
        const NamelessFile file(room_bytes);
        WorkerProcess other({{"/bin/sh", "-c", "echo film >" + file.path().string() + "; echo written"}, {}});
        std::string line;
        ASSERT_EQ(other.read_line(line, std::chrono::seconds(60)), ReadStatus::line);
        EXPECT_EQ(read_text(file.path()), "film\n");
        EXPECT_FALSE(fs::exists(fs::read_symlink(file.path())));
    }
}

}  // namespace
}  // namespace ptb
