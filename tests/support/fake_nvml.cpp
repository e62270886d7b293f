// As much of NVIDIA's Management Library as an energy counter needs: one GPU, whose counter grows by 1.5 J a
// reading. FAKE_NVML_ERROR is what it answers when asked for energy.
#include <cstdlib>
#include <cstring>

namespace {
constexpr const char* uuid = "GPU-00112233-4455-6677-8899-aabbccddeeff";
int the_gpu = 0;
bool ready = false;
unsigned long long energy_mj = 1000;
}  // namespace

extern "C" {

int nvmlInit_v2() {
    ready = true;
    return 0;
}

int nvmlShutdown() {
    ready = false;
    return 0;
}

const char* nvmlErrorString(int code) { return code == 3 ? "Not Supported" : "Not Found"; }

int nvmlDeviceGetHandleByUUID(const char* asked, void** gpu) {
    if (!ready || std::strcmp(asked, uuid) != 0) return 6;
    *gpu = &the_gpu;
    return 0;
}

int nvmlDeviceGetTotalEnergyConsumption(void* gpu, unsigned long long* energy) {
    const char* const error = std::getenv("FAKE_NVML_ERROR");
    if (error != nullptr) return std::atoi(error);
    if (!ready || gpu != &the_gpu) return 2;
    *energy = energy_mj += 1500;
    return 0;
}

}  // extern "C"
