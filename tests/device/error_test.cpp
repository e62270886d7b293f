#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>

#include "core/integrator/registry.h"
#include "tests/support/devices.h"

namespace ptb {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A folder of changed kernel files, removed at the end.
class OverrideFolder {
  public:
    OverrideFolder() : path_(std::filesystem::path(PTB_BINARY_DIR) / ("override-" + test_name())) {
        std::filesystem::remove_all(path_);
    }
    ~OverrideFolder() { std::filesystem::remove_all(path_); }
    OverrideFolder(const OverrideFolder&) = delete;
    OverrideFolder& operator=(const OverrideFolder&) = delete;

    void write(const std::string& file, const std::string& text) const {
        std::filesystem::create_directories((path_ / file).parent_path());
        std::ofstream(path_ / file) << text;
    }
    const std::filesystem::path& path() const { return path_; }

  private:
    static std::string test_name() { return testing::UnitTest::GetInstance()->current_test_info()->name(); }
    std::filesystem::path path_;
};

TEST(Errors, failed_launch_names_call_work_device_error_and_code) {
    const Scene scene = load_scene(std::filesystem::path(PTB_SOURCE_DIR) / "configs/scenes/thesis.json");
    on_every_device([&](const ocl::Device& device) {
        const Integrator thesis = integrator("thesis");
        RenderJob job;
        job.size = {8, 8};
        job.work_group_x = static_cast<int>(device.info.max_work_group) * 2;
        const ocl::Program program =
            ocl::build(device, kernel_source(thesis.file()), thesis.options(device, scene, job));
        const auto render = thesis.make(device, program, scene, job);
        try {
            render->advance(64);
            FAIL() << "a work-group that is too large was accepted";
        } catch (const ocl::Error& error) {
            EXPECT_THAT(error.what(),
                        AllOf(HasSubstr("clEnqueueNDRangeKernel(thesis_render, global "),
                              HasSubstr("local " + std::to_string(job.work_group_x)),
                              HasSubstr("on \"" + device.info.name + "\""), Not(HasSubstr("\n"))));
            EXPECT_THAT(error.what(), HasSubstr(std::string(ocl::error_name(error.code())) + " (" +
                                                std::to_string(error.code()) + ")"));
            EXPECT_THAT(ocl::error_name(error.code()), HasSubstr("CL_INVALID_WORK_"));
        }
    });
}

TEST(Errors, unknown_codes_have_no_made_up_name) {
    EXPECT_STREQ(ocl::error_name(-54), "CL_INVALID_WORK_GROUP_SIZE");
    EXPECT_STREQ(ocl::error_name(-9999), "unknown error");
}

TEST(Errors, broken_kernel_file_is_named_with_its_line) {
    const OverrideFolder folder;
    folder.write("scene/scatter.h", "/* one */\n/* two */\nthis is not OpenCL C;\n");
    on_every_device([&](const ocl::Device& device) {
        try {
            ocl::build(device, kernel_source("pt/pt.cl", folder.path()), "-cl-std=CL1.2");
            FAIL() << "a broken kernel was accepted";
        } catch (const ocl::BuildError& error) {
            EXPECT_THAT(error.what(), AllOf(HasSubstr(device.info.name), Not(HasSubstr("\n"))));
            EXPECT_THAT(error.log(), HasSubstr("scene/scatter.h:3"));
        }
    });
}

TEST(Errors, unknown_device_is_refused_with_its_key) {
    try {
        ocl::open_device("nosuch:7");
        FAIL() << "a device that is not there was opened";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("\"nosuch:7\""));
    }
}

TEST(Source, flattened_text_includes_each_file_once_and_keeps_lines) {
    const OverrideFolder folder;
    folder.write("top.cl", "#include \"a.h\"\n#include \"b.h\"\nint top;\n");
    folder.write("a.h", "int a;\n");
    folder.write("b.h", "#include \"a.h\"\nint b;\n");
    const KernelSource source = kernel_source("top.cl", folder.path());
    EXPECT_EQ(source.text,
              "#line 1 \"top.cl\"\n"
              "#line 1 \"a.h\"\nint a;\n"
              "#line 2 \"top.cl\"\n"
              "#line 1 \"b.h\"\n"
              "#line 2 \"b.h\"\nint b;\n"
              "#line 3 \"top.cl\"\nint top;\n");
    EXPECT_TRUE(source.overridden);
}

TEST(Source, a_file_that_a_condition_may_leave_out_is_there_for_the_next) {
    const OverrideFolder folder;
    folder.write("top.cl", "#ifdef A\n#include \"a.h\"\n#endif\n#include \"b.h\"\n#include \"b.h\"\n");
    folder.write("a.h", "#ifndef A_H\n#include \"b.h\"\nint a;\n#endif\n");
    folder.write("b.h", "#ifndef B_H\n#define B_H\nint b;\n#endif\n");
    const std::string text = kernel_source("top.cl", folder.path()).text;
    const auto first = text.find("int b;"), second = text.find("int b;", first + 1);
    EXPECT_LT(first, text.find("int a;"));
    EXPECT_NE(second, std::string::npos) << text;
    EXPECT_EQ(text.find("int b;", second + 1), std::string::npos) << text;
}

TEST(Source, hash_follows_the_text) {
    const OverrideFolder folder;
    const KernelSource shipped = kernel_source("pt/pt.cl", folder.path());
    EXPECT_FALSE(shipped.overridden) << "nothing lies in the folder";
    EXPECT_EQ(shipped.hash.size(), 16u);
    std::ifstream stream(std::filesystem::path(PTB_SOURCE_DIR) / "kernels/scene/scatter.h");
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    folder.write("scene/scatter.h", text);
    EXPECT_EQ(kernel_source("pt/pt.cl", folder.path()).hash, shipped.hash) << "same text, other place";
    folder.write("scene/scatter.h", text + "/* changed */\n");
    EXPECT_NE(kernel_source("pt/pt.cl", folder.path()).hash, shipped.hash);
}

TEST(Source, missing_include_names_the_line_that_wants_it) {
    const OverrideFolder folder;
    folder.write("top.cl", "/* one */\n#include \"nowhere.h\"\n");
    try {
        kernel_source("top.cl", folder.path());
        FAIL() << "a missing include was accepted";
    } catch (const SourceError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("top.cl:2"), HasSubstr("\"nowhere.h\""),
                                        HasSubstr(folder.path().string())));
    }
}

TEST(Source, embedded_files_are_those_of_the_source_tree) {
    const auto kernels = std::filesystem::path(PTB_SOURCE_DIR) / "kernels";
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kernels)) {
        const std::string extension = entry.path().extension().string();
        if (extension == ".cl" || extension == ".h")
            files.push_back(entry.path().lexically_relative(kernels).string());
    }
    EXPECT_THAT(embedded_files(), testing::UnorderedElementsAreArray(files));
}

}  // namespace
}  // namespace ptb
