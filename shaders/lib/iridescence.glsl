// SPDX-License-Identifier: Apache-2.0
// Colours of thin films: soap, oil, tempered steel. Belcour and Barla 2017, "A Practical Extension to Microfacet Theory
// for the Modeling of Varying Iridescence", as used by KHR_materials_iridescence: light bounces between the two
// interfaces of a film and interferes; the spectrum is integrated against the eye's sensitivity in closed form.
//   Units   thickness and path differences in nanometres. fp32 only: phases reach thousands of radians.

// Thinner films fade out: their index approaches that of the surroundings and they stop reflecting at grazing angles
// too, so that no film and a film of thickness 0 are the same.
const float kIridescenceFadeNanometers = 0.03f;
// The maximum reflectance of a base, or of both interfaces together: keeps indices and the series finite.
const float kMaxFilmReflectance = 0.9999f;

// The eye's response to interference: the Fourier transform of the CIE 1931 curves as Gaussians, with a second one for
// x. Belcour and Barla 2017, section 4.2 and supplement, with their constants multiplied out for nanometres: the
// frequency is 2 pi 1e-9 times their position, the decay (2 pi 1e-9)^2 times their variance, and the weight value
// sqrt(2 pi variance) over the integral of y, 1.0685e-7. difference: optical path difference; shift: phase in radians.
// Returns linear Rec. 709; near difference 0 it is the colour of a flat spectrum. fp32 only.
vec3 iridescenceSensitivity(float difference, vec3 shift) {
    float d2 = difference * difference;
    vec3 phase = vec3(0.010562034f, 0.011280203f, 0.013875786f) * difference + shift;
    vec3 decay = exp(-d2 * vec3(1.708547e-7f, 3.6733088e-7f, 2.6103525e-7f));
    vec3 xyz = vec3(0.84659f, 1.0002219f, 1.0011225f) * vec3(cos(phase.x), cos(phase.y), cos(phase.z)) * decay;
    xyz.x += 0.1538683f * cos(0.014073707f * difference + shift.x) * exp(-1.7876617e-7f * d2);
    return vec3(dot(xyz, vec3(3.2404542f, -1.5371385f, -0.4985314f)),
            dot(xyz, vec3(-0.9692660f, 1.8760108f, 0.0415560f)), dot(xyz, vec3(0.0556434f, -0.2040259f, 1.0572252f)));
}

// The phase shift of reflection: half a wave if the medium behind is denser. Radians.
float reflectionPhase(float iorBefore, float iorBehind) { return iorBehind < iorBefore ? 0.0f : kPi; }

// Reflectance of a base covered by a film. outsideIor: of the medium outside; filmIor > 0: of the film; f0: of the base
// in air; thickness >= 0; cosine in [0, 1] with the normal. Two orders of interference, as the paper advises. Colours
// outside Rec. 709 are clipped, so there is no gain of energy. Schlick's term of f0 for thickness 0. Returns [0, 1].
// fp32 only.
vec3 fresnelIridescent(float outsideIor, float filmIor, vec3 f0, float thickness, float cosine) {
    float fade = saturate(thickness / kIridescenceFadeNanometers);
    float presence = fade * fade * (3.0f - 2.0f * fade);
    float ior = mix(outsideIor, filmIor, presence);
    float eta = outsideIor / ior;
    float cosine2 = 1.0f - eta * eta * (1.0f - cosine) * (1.0f + cosine); // inside the film, squared
    float inside = sqrt(max(cosine2, 0.0f));
    float outer0 = sq((ior - outsideIor) / (ior + outsideIor));
    float outer = outer0 + (1.0f - outer0) * presence * pow5(1.0f - cosine);
    vec3 root = sqrt(clamp(f0, 0.0f, kMaxFilmReflectance));
    vec3 baseIor = (1.0f + root) / (1.0f - root);
    vec3 amplitude = (baseIor - ior) / (baseIor + ior);
    vec3 inner = amplitude * amplitude + (1.0f - amplitude * amplitude) * pow5(1.0f - inside);

    float difference = 2.0f * ior * thickness * inside;
    vec3 shift = vec3(reflectionPhase(ior, baseIor.x), reflectionPhase(ior, baseIor.y), reflectionPhase(ior, baseIor.z)) +
            (kPi - reflectionPhase(outsideIor, ior));
    vec3 bounce = clamp(outer * inner, 0.0f, kMaxFilmReflectance);
    vec3 through = (1.0f - outer) * (1.0f - outer) * inner / (1.0f - bounce);
    vec3 order = sqrt(bounce);
    vec3 first = (through - (1.0f - outer)) * order;
    vec3 waves = first * iridescenceSensitivity(difference, shift) +
            first * order * iridescenceSensitivity(2.0f * difference, 2.0f * shift);
    return cosine2 < 0.0f ? vec3(1.0f) : saturate(outer + through + 2.0f * waves);
}

// The f0 for which fresnelSchlick() gives this reflectance at this cosine: it lets a film affect lobes that take an f0.
// 1 - 2^-10 where Schlick's weight reaches 1 and f0 does not matter. All in [0, 1]. fp32 only.
vec3 f0FromFresnel(vec3 reflectance, float cosine) {
    float weight = min(pow5(1.0f - cosine), 0.9990234375f);
    return saturate((reflectance - weight) / (1.0f - weight));
}
