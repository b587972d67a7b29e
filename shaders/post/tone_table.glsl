// SPDX-License-Identifier: Apache-2.0
// Tone mapping by a table of colours (ToneTable.h); included after shaders/lib/color.glsl. Texels are fetched and
// weighted here, because the weights of a sampler have only 8 bits.

vec3 tableEntry(ivec3 at, int size) { return texelFetch(materialParams_table, ivec2(at.x + at.z * size, at.y), 0).rgb; }

// Tetrahedral interpolation: the diagonal from black to white divides the cell into six tetrahedra. It needs four
// entries instead of the eight of trilinear interpolation, and greys are mixed from greys alone. Sakamoto and Itooka,
// US patent 4 275 413 (1978). fraction in [0, 1]^3.
vec3 interpolatedEntry(ivec3 corner, vec3 fraction, int size) {
    const ivec3 kX = ivec3(1, 0, 0), kY = ivec3(0, 1, 0), kZ = ivec3(0, 0, 1);
    bool xy = fraction.x >= fraction.y, xz = fraction.x >= fraction.z, yz = fraction.y >= fraction.z;
    ivec3 largest = xy ? (xz ? kX : kZ) : (yz ? kY : kZ);
    ivec3 smallest = xy ? (yz ? kZ : kY) : (xz ? kZ : kX); // never the same axis, even if all are equal
    float high = max3(fraction);
    float low = min(fraction.x, min(fraction.y, fraction.z));
    float middle = max(min(fraction.x, fraction.y), min(max(fraction.x, fraction.y), fraction.z));
    vec3 color = tableEntry(corner, size) * (1.0 - high);
    color += tableEntry(corner + largest, size) * (high - middle);
    color += tableEntry(corner + ivec3(1) - smallest, size) * (middle - low);
    return color + tableEntry(corner + ivec3(1), size) * low;
}

vec3 colorOfTable(vec3 unclamped) {
    int size = textureSize(materialParams_table, 0).y;
    vec3 light = clamp(unclamped, 0.0, 1e4);
    vec3 at = vec3(toneTableCoordinate(light.x), toneTableCoordinate(light.y), toneTableCoordinate(light.z)) *
            float(size - 1);
    vec3 corner = min(floor(at), vec3(float(size - 2)));
    return interpolatedEntry(ivec3(corner), at - corner, size);
}
