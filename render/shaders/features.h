// What a scene has need of: kernels are compiled without the rest.
const int kFeatureCull = 1;        // single-sided triangles
const int kFeatureMask = 2;        // cut-out materials
const int kFeatureBlend = 4;       // blended materials
const int kFeatureTexture = 8;
const int kFeatureShiny = 16;      // materials that are not matte
const int kFeatureMaps = 32;       // surface, normal or occlusion textures
const int kFeatureColours = 64;    // vertex colours
const int kFeatureSecondUv = 128;
const int kFeatureTransform = 256;
const int kFeatureUnlit = 512;
const int kFeatureEmission = 1024;  // emission textures
const int kMostLayers = 8;         // of what blends, along a ray
