// SPDX-License-Identifier: Apache-2.0
// A thin film between the base and what lies above it. Everything in 32 bits: phases reach thousands of radians.

struct Film {
    float strength;           // 0: none
    highp float ior;
    highp float thickness;    // nanometres
    highp float outsideIor;   // of what lies above: air, or a coat
    vec3 baseF0;              // of the base below it, in air
    vec3 bareF0;              // of the base where there is no film
};

Film filmOf(MaterialInputs material) {
    Film film;
    film.strength = saturate(material.iridescence);
    film.ior = max(material.iridescenceIor, 1.0);
    film.thickness = max(material.iridescenceThickness, 0.0);
    film.outsideIor = 1.0;
    return film;
}

// cosine: in what lies above.
highp vec3 reflectanceBelow(Film film, highp float cosine) {
    return fresnelIridescent(film.outsideIor, film.ior, film.baseF0, film.thickness, cosine);
}

// cosine: in air. Below a coat light is steeper, else films of a lesser index than the coat's would reflect it totally.
highp vec3 filmReflectance(Film film, highp float cosine) {
    return reflectanceBelow(film, refractedCosine(cosine, film.outsideIor));
}

// For lobes that take an f0. Where everything is reflected it cannot be told: the film stays as it is a little before.
const float kMinFilmCosine = 0.03125;
highp vec3 filmF0(Film film, highp float nov) {
    highp float cosine = max(refractedCosine(nov, film.outsideIor), kMinFilmCosine);
    return f0FromFresnel(reflectanceBelow(film, cosine), cosine);
}
