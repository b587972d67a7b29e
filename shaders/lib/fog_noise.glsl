// SPDX-License-Identifier: Apache-2.0
// Noise in space, by which the density of fog varies.

// All bits depend on all bits. Wellons 2018, "Prospecting for Hash Functions": two rounds, with constants of a bias of
// 0.11.
uint hashBits(uint x) {
    x = (x ^ (x >> 16u)) * 0x21f0aaadu;
    x = (x ^ (x >> 15u)) * 0x735a2d97u;
    return x ^ (x >> 15u);
}

// Noise of a lattice: evenly distributed numbers at its points, and between them the interpolation whose slope and
// curvature have no steps (Perlin 2002, "Improving Noise"). Its mean is 0. The numbers are those of integers, so they are the same
// on all devices. place: in cells; mask: 2^k - 1: the lattice repeats after 2^k cells; seed: selects another lattice.
// Returns [-1, 1], within rounding. fp32 only: 16 bits cannot count cells.
float latticeNoise(vec3 place, uint mask, uint seed) {
    vec3 cell = floor(place);
    vec3 f = place - cell;
    vec3 share = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
    uint x = uint(int(cell.x)), y = uint(int(cell.y)), z = uint(int(cell.z));
    float sum = 0.0f;
    for (int i = 0; i < 4; ++i) {
        uint up = uint(i & 1), behind = uint(i >> 1);
        uint row = hashBits(((y + up) & mask) + hashBits(((z + behind) & mask) + seed));
        float before = float(hashBits((x & mask) + row) >> 8u) * 1.1920928955078125e-7f - 1.0f;
        float after = float(hashBits(((x + 1u) & mask) + row) >> 8u) * 1.1920928955078125e-7f - 1.0f;
        float weight = (up == 1u ? share.y : 1.0f - share.y) * (behind == 1u ? share.z : 1.0f - share.z);
        sum += (before + (after - before) * share.x) * weight;
    }
    return sum;
}

// By how much the density of fog varies, relative to its amplitude: octaves of noise, each half as wide and half as
// strong as the one before (Ebert et al. 1994, "Texturing and Modeling", chapter 2). What is narrower than a sample fades out:
// its mean, which is 0, is what is left. place: in cells of the widest octave, which repeats after 256; octaves: [1, 4];
// width: of a sample, in such cells, >= 0. Returns [-1, 1], within rounding. fp32 only.
float fogNoise(vec3 place, float octaves, float width) {
    float sum = 0.0f, all = 0.0f, weight = 1.0f, scale = 1.0f;
    for (int i = 0; i < 4; ++i) {
        if (float(i) < octaves) {
            float kept = saturate(2.0f - 2.0f * width * scale);
            if (kept > 0.0f) sum += kept * weight * latticeNoise(place * scale, (256u << uint(i)) - 1u, uint(i));
            all += weight;
            weight *= 0.5f;
            scale *= 2.0f;
        }
    }
    return sum / max(all, 1.0f);
}
