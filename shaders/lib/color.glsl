// SPDX-License-Identifier: Apache-2.0
// From scene-referred linear Rec. 709 to display values: tone mappers, transfer functions, dither noise.
// The tone mappers, except toneMapMobile(), square scene-referred values, which exceeds the range of 16 bits: they are
// fp32 only.

const int kToneMapLinear = 0; // clamps
const int kToneMapAces = 1;   // the ACES rendering transforms, with their desaturation of highlights
const int kToneMapFilmic = 2; // the ACES curve per component: more contrast, hues shift
const int kToneMapMobile = 3; // one division, transfer function included

// Relative luminance of linear Rec. 709. ITU-R BT.709-6, item 3.2.
float luminance(vec3 linear) { return dot(linear, vec3(0.2126f, 0.7152f, 0.0722f)); }

// The part of `light` that shadows take, of which they leave `left`: [0, 1]; 0 where there is no light. fp32 only:
// both have any scale.
float shadowedShare(vec3 left, vec3 light) {
    float open = luminance(light);
    return open > 0.0f ? clamp(1.0f - luminance(left) / open, 0.0f, 1.0f) : 0.0f;
}

// ACES reference rendering and output transform for a Rec. 709 display, fitted by Hill: "ACES.hlsl" of Pettineo's
// BakingLab, 2016. The two matrices convert to and from the space in which the curve is applied, which desaturates
// bright colours.
// x >= 0; the result may leave [0, 1] by a few per cent in saturated colours.
vec3 toneMapAces(vec3 x) {
    vec3 v = vec3(dot(x, vec3(0.59719f, 0.35458f, 0.04823f)), dot(x, vec3(0.07600f, 0.90834f, 0.01566f)),
            dot(x, vec3(0.02840f, 0.13383f, 0.83777f)));
    vec3 y = (v * (v + 0.0245786f) - 0.000090537f) / (v * (0.983729f * v + 0.4329510f) + 0.238081f);
    return vec3(dot(y, vec3(1.60475f, -0.53108f, -0.07367f)), dot(y, vec3(-0.10208f, 1.10813f, -0.00605f)),
            dot(y, vec3(-0.00327f, -0.07276f, 1.07602f)));
}

// The curve of ACES per component, brighter: Narkowicz 2015, "ACES Filmic Tone Mapping Curve". x >= 0; the result
// exceeds 1 from x = 7.2 on, by at most 3 %.
vec3 toneMapFilmic(vec3 x) { return (x * (2.51f * x + 0.03f)) / (x * (2.43f * x + 0.59f) + 0.14f); }

// Approximates toneMapFilmic() followed by the sRGB transfer function in one division: Guy and Agopian 2018, "High
// performance on mobile". The result is displayed directly: do not apply srgbFromLinear().
vec3 toneMapMobile(vec3 x) { return x / (x + vec3(0.155f)) * 1.019f; }

// Whether the mapper's result is already encoded for the display, so that no transfer function may follow.
bool toneMapIncludesTransfer(int mapper) { return mapper == kToneMapMobile; }

// Scene-referred, exposed linear colour -> [0, 1]. Negative components (out of gamut) count as 0; values above 1e4,
// where all curves are flat, are clamped so that x^2 does not overflow fp32.
vec3 toneMap(vec3 color, int mapper) {
    vec3 x = clamp(color, 0.0f, 1e4f);
    if (mapper == kToneMapAces) {
        x = toneMapAces(x);
    } else if (mapper == kToneMapFilmic) {
        x = toneMapFilmic(x);
    } else if (mapper == kToneMapMobile) {
        x = toneMapMobile(x);
    }
    return saturate(x);
}

// Inverse of toneMapFilmic(), per component: the root of its quadratic, in the form that does not cancel. The light
// that an already tone-mapped image must emit to look unchanged. x in [0, 1]; 1 gives the light at which the curve
// reaches 1.
// fp32 only: the bright end is steep.
float inverseTonemap(float x) {
    float y = saturate(x);
    float a = 2.51f - 2.43f * y;
    float b = 0.59f * y - 0.03f;
    float root = sqrt(b * b + 0.56f * a * y);
    return b < 0.0f ? 0.28f * y / (root - b) : (b + root) / (2.0f * a);
}

vec3 inverseTonemap(vec3 x) { return vec3(inverseTonemap(x.x), inverseTonemap(x.y), inverseTonemap(x.z)); }

// IEC 61966-2-1, the sRGB transfer function, one component. [0, 1] -> [0, 1].
float srgbFromLinear(float x) {
    return x <= 0.0031308f ? 12.92f * x : 1.055f * pow(x, 1.0f / 2.4f) - 0.055f;
}

// IEC 61966-2-1, inverse transfer function, one component. [0, 1] -> [0, 1].
float linearFromSrgb(float x) {
    return x <= 0.04045f ? x * (1.0f / 12.92f) : pow((x + 0.055f) * (1.0f / 1.055f), 2.4f);
}

vec3 srgbFromLinear(vec3 x) { return vec3(srgbFromLinear(x.x), srgbFromLinear(x.y), srgbFromLinear(x.z)); }
vec3 linearFromSrgb(vec3 x) { return vec3(linearFromSrgb(x.x), linearFromSrgb(x.y), linearFromSrgb(x.z)); }

// inverseTonemap() of a display value: the transfer function is undone first. [0, 1]. fp32 only.
vec3 inverseTonemapSRGB(vec3 x) { return inverseTonemap(linearFromSrgb(saturate(x))); }

// Video to colour, both encoded with the transfer function: JFIF 1.02, the full range of ITU-R BT.601.
// y, cbcr in [0, 1]. The result may leave [0, 1]: not every triple is a colour.
vec3 ycbcrToRgb(float y, vec2 cbcr) {
    float cb = cbcr.x - 0.5f;
    float cr = cbcr.y - 0.5f;
    return vec3(y + 1.402f * cr, y - 0.344136f * cb - 0.714136f * cr, y + 1.772f * cb);
}

// ---- the axes of a tone-mapping table (ToneTable.h): logarithmic, so that shadows get as many entries as highlights.
// The offset makes the first cells nearly linear, so that the table includes black. 16 stops, [0, 256); all curves are
// flat beyond.
// fp32 only, both ways: the logarithm of 16 stops leaves 16 bits no digits for the position between two entries.
const float kToneTableOffset = 0.00390625f; // 2^-8
const float kToneTableStops = 16.0f;

// Light of one component -> [0, 1]; negative light is black. fp32 only.
float toneTableCoordinate(float light) {
    return saturate((log2(max(light, 0.0f) + kToneTableOffset) + 8.0f) * (1.0f / kToneTableStops));
}

// Inverse of toneTableCoordinate() on [0, 1]. fp32 only.
float lightFromToneTableCoordinate(float coordinate) {
    return max(exp2(coordinate * kToneTableStops - 8.0f) - kToneTableOffset, 0.0f);
}
