// SPDX-License-Identifier: Apache-2.0
// Colour grading of scene-referred light before the tone mapper, in linear Rec. 2020, which contains nearly all that
// grading makes of Rec. 709. Each function is the identity for its neutral values.
// fp32 only: scene-referred light has more stops than 16 bits have digits.

// ITU-R BT.2087-0, from the primaries of BT.709 and BT.2020 and D65.
vec3 rec709FromRec2020(vec3 x) {
    return vec3(dot(x, vec3(1.660491002f, -0.587641139f, -0.072849863f)),
            dot(x, vec3(-0.124550475f, 1.132899897f, -0.008349423f)),
            dot(x, vec3(-0.018150763f, -0.100578898f, 1.118729661f)));
}

// Relative luminance of linear Rec. 2020. ITU-R BT.2020-2, table 4.
float luminanceOfRec2020(vec3 x) { return dot(x, vec3(0.262700212f, 0.677998072f, 0.059301716f)); }

// ACEScct, the logarithm in which grading is even to the eye, with a linear part near black. S-2016-001, section 4.4.
// x >= 0.
float gradingLog(float x) {
    return x <= 0.0078125f ? 10.5402377416545f * x + 0.0729055341958355f : (log2(x) + 9.72f) * (1.0f / 17.52f);
}
vec3 gradingLog(vec3 x) { return vec3(gradingLog(x.x), gradingLog(x.y), gradingLog(x.z)); }

// Inverse of gradingLog(), up to the light of the largest half float.
float lightFromGradingLog(float x) {
    return x <= 0.155251141552511f ? (x - 0.0729055341958355f) * (1.0f / 10.5402377416545f)
                                   : exp2(min(x * 17.52f - 9.72f, 16.0f));
}
vec3 lightFromGradingLog(vec3 x) {
    return vec3(lightFromGradingLog(x.x), lightFromGradingLog(x.y), lightFromGradingLog(x.z));
}

// Factors of dark, middle and bright colours. ranges: luminances between which the dark ones end (x, y) and the bright
// ones begin (z, w); x < y, z < w.
vec3 tonalBalance(vec3 light, vec3 shadows, vec3 midtones, vec3 highlights, vec4 ranges) {
    float y = luminanceOfRec2020(light);
    float dark = 1.0f - smoothstep(ranges.x, ranges.y, y);
    float bright = smoothstep(ranges.z, ranges.w, y);
    return light * (shadows * dark + midtones * (1.0f - dark - bright) + highlights * bright);
}

// The colour decision list of the American Society of Cinematographers, version 1.2, on logarithms.
vec3 slopeOffsetPower(vec3 x, vec3 slope, vec3 offset, vec3 power) {
    vec3 y = max(x * slope + offset, 0.0f);
    return vec3(pow(y.x, power.x), pow(y.y, power.y), pow(y.z, power.z));
}

// Away from or towards middle grey, 0.18, on logarithms.
vec3 contrasted(vec3 x, float contrast) { return 0.4135884f + (x - 0.4135884f) * contrast; }

// Distances from grey: all of them by `saturation`, those of pale colours also by `vibrance`, as far as no component
// becomes negative, so that luminance stays. light >= 0.
vec3 saturated(vec3 light, float saturation, float vibrance) {
    float y = luminanceOfRec2020(light);
    float most = max(light.x, max(light.y, light.z));
    float least = min(light.x, min(light.y, light.z));
    float pale = most > 0.0f ? least / most : 1.0f; // 1: grey
    float chroma = saturation * (1.0f + (vibrance - 1.0f) * pale);
    if (least < y) chroma = min(chroma, y / (y - least));
    return max(vec3(y) + (light - y) * chroma, 0.0f);
}

// A gamma up to `midPoint`, and a straight line beyond it. x >= 0, midPoint > 0.
float gradingCurve(float x, float shadowGamma, float midPoint, float highlightScale) {
    return x <= midPoint ? midPoint * pow(x / midPoint, shadowGamma) : midPoint + (x - midPoint) * highlightScale;
}

// What Rec. 709 cannot show, with less chroma, so that its luminance and hue stay. Without luminance it is black.
vec3 withinGamut(vec3 light) {
    float y = max(luminance(light), 0.0f);
    float least = min(light.x, min(light.y, light.z));
    float chroma = least < 0.0f ? y / max(y - least, 1e-30f) : 1.0f;
    return max(vec3(y) + (light - y) * chroma, 0.0f);
}

// What an eye sees at night: rods add to the signals of the cones, so that dark colours are brighter, bluer and paler
// (the Purkinje shift). Kirk and O'Brien 2011, "Perceptually Based Tone Mapping for Low-Light Conditions", with the
// opponent model of Cao et al. 2008 and its parameters K = 45, S = 10, k3 = 0.6, rw = 0.139, p = 0.6189; rods enter by
// 0.2, 0.2, 0.3 of their signal. Cones and rods see linear Rec. 709 as in Patry 2021, "Real-Time Samurai Cinema"; a
// light of 1 is `kNightLight` times their unit, with which rods shift middle grey by twice its blue. The matrix of the
// last step is all of theirs together: from the gains of the cones to Rec. 709. light >= 0; amount: 0 to 1.
// The result may leave Rec. 709.
vec3 nightVision(vec3 light, float amount) {
    const float kNightLight = 380.0f;
    float rods = dot(light, vec3(0.466386f, 15.564362f, 10.059963f));
    vec3 cones = vec3(dot(light, vec3(7.696847f, 18.424824f, 2.068096f)),
            dot(light, vec3(2.431137f, 18.697937f, 3.012463f)), dot(light, vec3(0.289117f, 1.401833f, 13.792292f)));
    vec3 seen = (cones + vec3(0.2f, 0.2f, 0.3f) * rods) * kNightLight;
    vec3 g = vec3(inversesqrt(1.0f + 0.517882645f * seen.x), inversesqrt(1.0f + 0.840935732f * seen.y),
            inversesqrt(1.0f + 0.205428287f * seen.z)); // 0.33 over the most sensitivity of a kind of cones
    vec3 shift = vec3(dot(g, vec3(0.319458494f, -0.342068047f, 0.010506945f)),
            dot(g, vec3(0.058097612f, 0.239182537f, -0.011333066f)),
            dot(g, vec3(0.659213676f, 0.654597998f, 0.061863378f)));
    return light + shift * (rods * amount);
}

struct Grading {
    float nightAdaptation; // nightVision(); 0: none
    vec3 mixRed, mixGreen, mixBlue; // linear Rec. 2020 from linear Rec. 709: exposure, white balance, channel mixer
    vec3 shadows, midtones, highlights;
    vec4 tonalRanges; // tonalBalance()
    vec3 slope, offset, power;
    float contrast, saturation, vibrance;
    vec3 shadowGamma, midPoint, highlightScale;
    bool mapsGamut;
};

// The matrix to linear Rec. 2020 alone (ITU-R BT.2087-0), and neutral values of everything else.
Grading neutralGrading() {
    Grading grading;
    grading.nightAdaptation = 0.0f;
    grading.mixRed = vec3(0.627403896f, 0.329283038f, 0.043313066f);
    grading.mixGreen = vec3(0.069097289f, 0.919540395f, 0.011362316f);
    grading.mixBlue = vec3(0.016391439f, 0.088013308f, 0.895595253f);
    grading.shadows = vec3(1.0f);
    grading.midtones = vec3(1.0f);
    grading.highlights = vec3(1.0f);
    grading.tonalRanges = vec4(0.0f, 0.333f, 0.55f, 1.0f);
    grading.slope = vec3(1.0f);
    grading.offset = vec3(0.0f);
    grading.power = vec3(1.0f);
    grading.contrast = 1.0f;
    grading.saturation = 1.0f;
    grading.vibrance = 1.0f;
    grading.shadowGamma = vec3(1.0f);
    grading.midPoint = vec3(1.0f);
    grading.highlightScale = vec3(1.0f);
    grading.mapsGamut = false;
    return grading;
}

// light: linear Rec. 709, as the result, which is >= 0.
vec3 graded(vec3 light, Grading grading) {
    if (grading.nightAdaptation > 0.0f) light = nightVision(max(light, 0.0f), grading.nightAdaptation);
    vec3 color = vec3(dot(light, grading.mixRed), dot(light, grading.mixGreen), dot(light, grading.mixBlue));
    color = tonalBalance(max(color, 0.0f), grading.shadows, grading.midtones, grading.highlights, grading.tonalRanges);
    vec3 even = slopeOffsetPower(gradingLog(color), grading.slope, grading.offset, grading.power);
    color = max(lightFromGradingLog(contrasted(even, grading.contrast)), 0.0f);
    color = saturated(color, grading.saturation, grading.vibrance);
    vec3 gamma = grading.shadowGamma;
    color = vec3(gradingCurve(color.x, gamma.x, grading.midPoint.x, grading.highlightScale.x),
            gradingCurve(color.y, gamma.y, grading.midPoint.y, grading.highlightScale.y),
            gradingCurve(color.z, gamma.z, grading.midPoint.z, grading.highlightScale.z));
    color = rec709FromRec2020(color);
    return grading.mapsGamut ? withinGamut(color) : max(color, 0.0f);
}
