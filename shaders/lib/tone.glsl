// SPDX-License-Identifier: Apache-2.0
// From scene-referred light to the values of a display: tone mappers beside those of color.glsl, and the colour spaces
// of displays. Included after color.glsl.
// fp32 only: scene-referred light has more stops than 16 bits have digits.

// They follow those of color.glsl, in the order of ToneMapper (DisplayTransform.h); the looks of AgX come last.
const int kToneMapAgx = 4;
const int kToneMapPbrNeutral = 5;
const int kToneMapAcesReference = 6; // by a table alone (ToneTable.h); without one, the fit of it
const int kToneMapGeneric = 7;
const int kToneMapDisplayRange = 8; // false colours
const int kToneMapAgxGolden = 9;
const int kToneMapAgxPunchy = 10;

// How much a sample counts in its pixel, so that what is displayed of the weighted mean is about the mean of what is
// displayed of the samples: exactly so for grey and the curve x / (x + h), where h is the light that is displayed at half
// of white. Karis 2013, "Tone Mapping"; by the brightest component as in Lottes 2016, "Optimized Reversible Tonemapper
// for Resolve". brightest: multiplied by alpha; alpha: (0, 1], 0 gives 0.
float displayWeight(float brightest, float alpha, float perHalfWhite) {
    return alpha / max(alpha + max(brightest, 0.0f) * perHalfWhite, 1e-20f);
}

// In the order of OutputSpace.
const int kOutputSrgb = 0;
const int kOutputLinearRec709 = 1;
const int kOutputDisplayP3 = 2;
const int kOutputRec2020Pq = 3;

struct ToneSettings {
    int mapper;       // kToneMap...
    vec4 curve;       // of kToneMapGeneric: toneMapGeneric()
    int space;        // kOutput...
    float whiteShare; // of kOutputRec2020Pq: white as a share of 10 000 cd/m^2
};

ToneSettings toneSettings(int mapper, vec4 curve, int space, float whiteShare) {
    ToneSettings tone;
    tone.mapper = mapper;
    tone.curve = curve;
    tone.space = space;
    tone.whiteShare = whiteShare;
    return tone;
}

// The contrast of AgX (Sobotka 2022, "AgX"), a sigmoid through (0.606, 0.5), on logarithms in [0, 1]: the polynomial of
// Wrensch 2023, "Minimal AgX Implementation". At most 0.006 off the sigmoid. Black is below 0.
float agxContrast(float x) {
    float x2 = x * x;
    float x4 = x2 * x2;
    return x4 * (15.5f * x2 - 40.14f * x + 31.96f) - 6.868f * x2 * x + 0.4298f * x2 + 0.1191f * x - 0.00232f;
}

// 16.5 stops about middle grey -> [0, 1]. x >= 0.
float agxLog(float x) { return saturate((log2(max(x, 1e-10f)) + 12.47393f) * (1.0f / 16.5f)); }

// AgX: colours move towards white before the curve and back after it, so that bright ones lose their chroma. The looks
// are colour decision lists (ASC CDL 1.2) on what is displayed: golden and punchy as in Wrensch 2023. x >= 0.
vec3 toneMapAgx(vec3 x, int mapper) {
    vec3 v = vec3(dot(x, vec3(0.842479062f, 0.0784336f, 0.0792237451f)),
            dot(x, vec3(0.0423282422f, 0.878468636f, 0.0791661275f)),
            dot(x, vec3(0.0423756549f, 0.0784336f, 0.879142974f)));
    v = vec3(agxContrast(agxLog(v.x)), agxContrast(agxLog(v.y)), agxContrast(agxLog(v.z)));
    if (mapper != kToneMapAgx) {
        bool isGolden = mapper == kToneMapAgxGolden;
        vec3 slope = isGolden ? vec3(1.0f, 0.9f, 0.5f) : vec3(1.0f);
        float power = isGolden ? 0.8f : 1.35f;
        float saturation = isGolden ? 0.8f : 1.4f;
        v = max(v * slope, 0.0f);
        v = vec3(pow(v.x, power), pow(v.y, power), pow(v.z, power));
        float y = luminance(v);
        v = vec3(y) + (v - y) * saturation;
    }
    v = max(vec3(dot(v, vec3(1.196879005f, -0.0980208811f, -0.0990297441f)),
                    dot(v, vec3(-0.0528968518f, 1.15190313f, -0.0989611768f)),
                    dot(v, vec3(-0.0529716355f, -0.0980434501f, 1.151073673f))),
            0.0f);
    return vec3(pow(v.x, 2.2f), pow(v.y, 2.2f), pow(v.z, 2.2f));
}

// Khronos 2024, "PBR Neutral Tone Mapper": base colours under even light look as they were authored. What dielectrics
// reflect at normal incidence, 0.04, is taken off; from 0.76 on light is compressed, and loses chroma. x >= 0.
vec3 toneMapPbrNeutral(vec3 x) {
    const float kStart = 0.76f;
    float least = min(x.x, min(x.y, x.z));
    vec3 color = x - (least < 0.08f ? least - 6.25f * least * least : 0.04f);
    float peak = max(color.x, max(color.y, color.z));
    if (peak < kStart) return color;
    const float kRange = 1.0f - kStart;
    float shown = 1.0f - kRange * kRange / (peak + kRange - kStart);
    float grey = 1.0f - 1.0f / (0.15f * (peak - shown) + 1.0f);
    return mix(color * (shown / peak), vec3(shown), grey);
}

// a x^c / (x^c + b) per component, up to the light that is white. curve: c, a, b, that light. x >= 0.
vec3 toneMapGeneric(vec3 x, vec4 curve) {
    vec3 y = min(x, curve.w);
    vec3 p = vec3(pow(y.x, curve.x), pow(y.y, curve.x), pow(y.z, curve.x));
    return p * curve.y / (p + curve.z);
}

// Of kToneMapDisplayRange: 0 is seven stops below middle grey, which is grey itself, 15 is eight stops above it.
// Encoded for the display.
vec3 displayRangeColor(int stop) {
    if (stop <= 0) return vec3(0.0f);
    if (stop == 1) return vec3(0.06f, 0.0f, 0.25f);
    if (stop == 2) return vec3(0.12f, 0.0f, 0.55f);
    if (stop == 3) return vec3(0.0f, 0.1f, 0.9f);
    if (stop == 4) return vec3(0.0f, 0.4f, 1.0f);
    if (stop == 5) return vec3(0.0f, 0.75f, 0.9f);
    if (stop == 6) return vec3(0.0f, 0.6f, 0.35f);
    if (stop == 7) return vec3(0.5f);
    if (stop == 8) return vec3(0.5f, 0.8f, 0.1f);
    if (stop == 9) return vec3(1.0f, 0.95f, 0.0f);
    if (stop == 10) return vec3(1.0f, 0.65f, 0.0f);
    if (stop == 11) return vec3(1.0f, 0.35f, 0.0f);
    if (stop == 12) return vec3(0.8f, 0.0f, 0.0f);
    if (stop == 13) return vec3(1.0f, 0.0f, 0.6f);
    if (stop == 14) return vec3(1.0f, 0.6f, 0.95f);
    return vec3(1.0f);
}

// How many stops a colour is from middle grey, by its luminance, as false colours; mixed between two stops. Encoded for
// the display. x >= 0.
vec3 toneMapDisplayRange(vec3 x) {
    float place = clamp(log2(max(luminance(x), 1e-10f) * (1.0f / 0.18f)) + 7.0f, 0.0f, 15.0f);
    float below = min(floor(place), 14.0f);
    return mix(displayRangeColor(int(below)), displayRangeColor(int(below) + 1), place - below);
}

// toneMap() of all mappers; [0, 1].
vec3 toneMapped(vec3 color, ToneSettings tone) {
    if (tone.mapper <= kToneMapMobile) return toneMap(color, tone.mapper);
    vec3 x = clamp(color, 0.0f, 1e4f);
    if (tone.mapper == kToneMapPbrNeutral) {
        x = toneMapPbrNeutral(x);
    } else if (tone.mapper == kToneMapGeneric) {
        x = toneMapGeneric(x, tone.curve);
    } else if (tone.mapper == kToneMapDisplayRange) {
        x = toneMapDisplayRange(x);
    } else if (tone.mapper == kToneMapAcesReference) {
        x = toneMapAces(x);
    } else {
        x = toneMapAgx(x, tone.mapper);
    }
    return saturate(x);
}

// Whether toneMapped() is already encoded for an sRGB display.
bool toneMappedIncludesTransfer(int mapper) { return mapper == kToneMapMobile || mapper == kToneMapDisplayRange; }

// The perceptual quantizer, inverse electro-optical transfer function: SMPTE ST 2084:2014, equation 5.2. x: light as a
// share of 10 000 cd/m^2, [0, 1] -> [0, 1].
float pqFromLinear(float x) {
    float y = pow(max(x, 0.0f), 0.1593017578125f);
    return pow((0.8359375f + 18.8515625f * y) / (1.0f + 18.6875f * y), 78.84375f);
}
vec3 pqFromLinear(vec3 x) { return vec3(pqFromLinear(x.x), pqFromLinear(x.y), pqFromLinear(x.z)); }

// Linear Rec. 709 -> linear Display P3 with the same white, D65: from the chromaticities of SMPTE RP 431-2 (P3).
vec3 displayP3FromRec709(vec3 x) {
    return vec3(dot(x, vec3(0.822461969f, 0.177538031f, 0.0f)), dot(x, vec3(0.033194199f, 0.966805801f, 0.0f)),
            dot(x, vec3(0.017082631f, 0.072397440f, 0.910519929f)));
}

// ITU-R BT.2087-0.
vec3 rec2020FromRec709(vec3 x) {
    return vec3(dot(x, vec3(0.627403896f, 0.329283038f, 0.043313066f)),
            dot(x, vec3(0.069097289f, 0.919540395f, 0.011362316f)),
            dot(x, vec3(0.016391439f, 0.088013308f, 0.895595253f)));
}

// Linear Rec. 709, 1 is white -> the values of a display. What the space does not hold is clamped; PQ holds more light
// than white.
vec3 encodedForDisplay(vec3 color, ToneSettings tone) {
    if (tone.space == kOutputLinearRec709) return saturate(color);
    if (tone.space == kOutputDisplayP3) return srgbFromLinear(saturate(displayP3FromRec709(color)));
    if (tone.space == kOutputRec2020Pq) return pqFromLinear(saturate(rec2020FromRec709(color) * tone.whiteShare));
    return srgbFromLinear(saturate(color));
}

// Scene-referred, exposed linear Rec. 709 -> the values of a display.
vec3 displayColor(vec3 light, ToneSettings tone) {
    bool isSrgb = tone.space == kOutputSrgb;
    if (!isSrgb && tone.mapper == kToneMapLinear) return encodedForDisplay(clamp(light, -1e4f, 1e4f), tone);
    vec3 color = toneMapped(light, tone);
    bool isEncoded = toneMappedIncludesTransfer(tone.mapper);
    if (isSrgb) return isEncoded ? color : srgbFromLinear(color);
    return encodedForDisplay(isEncoded ? linearFromSrgb(color) : color, tone);
}
