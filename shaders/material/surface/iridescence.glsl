// SPDX-License-Identifier: Apache-2.0
// A thin film between the base and the layers above it. All in 32 bits: phases reach thousands of radians.

struct Film {
    float strength;           // 0: none
    highp float ior;
    highp float thickness;    // nanometres
    highp float outsideIor;   // of the medium above: air, or a coat
    vec3 baseF0;              // of the base below it, in air
    vec3 bareF0;              // of the base without the film
};

Film filmOf(MaterialInputs material) {
    Film film;
    film.strength = saturate(material.iridescence);
    film.ior = max(material.iridescenceIor, 1.0);
    film.thickness = max(material.iridescenceThickness, 0.0);
    film.outsideIor = 1.0;
    return film;
}

// cosine: in the medium above.
highp vec3 reflectanceBelow(Film film, highp float cosine) {
    return fresnelIridescent(film.outsideIor, film.ior, film.baseF0, film.thickness, cosine);
}

// cosine: in air. Light is steeper below a coat; otherwise films with a lower index than the coat would reflect it
// totally.
highp vec3 filmReflectance(Film film, highp float cosine) {
    return reflectanceBelow(film, refractedCosine(cosine, film.outsideIor));
}

// For lobes that take an f0. Under total reflection f0 is undefined: the film keeps its value from just before.
const float kMinFilmCosine = 0.03125;
highp vec3 filmF0(Film film, highp float nov) {
    highp float cosine = max(refractedCosine(nov, film.outsideIor), kMinFilmCosine);
    return f0FromFresnel(reflectanceBelow(film, cosine), cosine);
}
