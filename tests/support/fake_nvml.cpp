// As much of NVIDIA's Management Library as ptbench asks: one GPU, whose counter grows by 1.5 J a reading,
// which is hot and held back by its power cap, and does not tell its memory's clock. FAKE_NVML_ERROR is what
// it answers when asked for energy.
#include <cstdio>
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

int nvmlDeviceGetSerial(void*, char* text, unsigned bytes) {
    std::snprintf(text, bytes, "1650522012345");
    return 0;
}

int nvmlDeviceGetEccMode(void*, int* now, int* after_restart) {
    *now = 1;
    *after_restart = 0;
    return 0;
}

int nvmlDeviceGetMaxClockInfo(void*, int clock, unsigned* mhz) {
    *mhz = clock == 1 ? 1980 : 2619;
    return 0;
}

int nvmlDeviceGetClockInfo(void*, int clock, unsigned* mhz) {
    *mhz = 1410;
    return clock == 1 ? 0 : 3;
}

int nvmlDeviceGetEnforcedPowerLimit(void*, unsigned* milliwatts) {
    *milliwatts = 700000;
    return 0;
}

int nvmlDeviceGetTemperature(void*, int, unsigned* celsius) {
    *celsius = 81;
    return 0;
}

int nvmlDeviceGetCurrentClocksThrottleReasons(void*, unsigned long long* bits) {
    *bits = 0x1 | 0x4 | 0x20;
    return 0;
}

}  // extern "C"
