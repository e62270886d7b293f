/* `probe_clock`: one work-item, one chain of dependent integer steps: as fast as the device's clock, and nothing else.
   The host times it to see the clock fall. */
__kernel void probe_clock(__global uint* out, const uint steps) {
    uint x = out[0] | 1u;
    for (uint i = 0; i < steps; ++i) {
        x ^= x << 13;
        x ^= x >> 17;
        x ^= x << 5;
    }
    out[0] = x;
}
