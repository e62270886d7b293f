#include "core/render/counted_rows.h"

#include <array>
#include <vector>

#include "shared/counts.h"

namespace ptb {

namespace {

constexpr std::size_t words = std::size_t{PTB_COUNTED_ROWS} * PTB_COUNTED_SUMS * 2;

}  // namespace

CountedRows::CountedRows(const ocl::Device& device, const ocl::Program& program) : device_(device) {
    if (program.options.find(count_option) == std::string::npos) return;
    rows_ = ocl::checked("counts", device_.info.name, [&] {
        return cl::Buffer(device_.context, CL_MEM_READ_WRITE, words * sizeof(std::uint32_t));
    });
    clear();
}

void CountedRows::give(cl::Kernel& kernel) const {
    if (rows_) kernel.setArg(kernel.getInfo<CL_KERNEL_NUM_ARGS>() - 1, *rows_);
}

void CountedRows::clear() const {
    if (!rows_) return;
    ocl::checked("counts", device_.info.name, [&] {
        device_.queue.enqueueFillBuffer(*rows_, 0u, 0, words * sizeof(std::uint32_t));
        device_.queue.finish();
    });
}

std::optional<Counts> CountedRows::read() const {
    if (!rows_) return std::nullopt;
    std::vector<std::uint32_t> read(words);
    ocl::checked("counts", device_.info.name, [&] {
        device_.queue.enqueueReadBuffer(*rows_, CL_TRUE, 0, words * sizeof(std::uint32_t), read.data());
    });
    std::array<std::uint64_t, PTB_COUNTED_SUMS> sums{};
    for (std::size_t i = 0; i < words / 2; ++i)
        sums[i % PTB_COUNTED_SUMS] += read[2 * i] | std::uint64_t{read[2 * i + 1]} << 32;
    return Counts{sums[PTB_COUNTED_SEGMENTS], sums[PTB_COUNTED_LANES],     sums[PTB_COUNTED_FLOPS],
                  sums[PTB_COUNTED_ROOTS],    sums[PTB_COUNTED_DIVISIONS], sums[PTB_COUNTED_BYTES],
                  sums[PTB_COUNTED_SEARCHES], sums[PTB_COUNTED_NODES],     sums[PTB_COUNTED_TRIANGLES]};
}

}  // namespace ptb
