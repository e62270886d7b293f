#include "core/integrator/large_buffer.h"

#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>

#include <sys/mman.h>

namespace ptb {

namespace {

struct Free {
    void operator()(void* memory) const { std::free(memory); }
};
using Pages = std::unique_ptr<void, Free>;

Pages in_large_pages(std::span<const std::byte> content) {
    constexpr std::size_t page_bytes = std::size_t{2} << 20;
    const std::size_t bytes = (content.size() + page_bytes - 1) / page_bytes * page_bytes;
    Pages pages(std::aligned_alloc(page_bytes, bytes));
    if (!pages) throw std::bad_alloc();
    madvise(pages.get(), bytes, MADV_HUGEPAGE);  // a wish: small pages are as right
    std::memcpy(pages.get(), content.data(), content.size());
    return pages;
}

/// Kernels keep buffers that were given to them, for longer than who made them.
void CL_CALLBACK free_pages(cl_mem, void* pages) { std::free(pages); }

}  // namespace

cl::Buffer large_buffer(const ocl::Device& device, std::span<const std::byte> content) {
    if (device.info.type != "CPU")
        return {device.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, content.size(),
                const_cast<std::byte*>(content.data())};
    Pages pages = in_large_pages(content);
    cl::Buffer buffer(device.context, CL_MEM_READ_ONLY | CL_MEM_USE_HOST_PTR, content.size(), pages.get());
    buffer.setDestructorCallback(free_pages, pages.get());
    pages.release();
    return buffer;
}

}  // namespace ptb
