// How exactly a frame is computed: every choice that trades time for truth, apart from what is drawn (FrameConfig).
// The defaults are the rung "standard". Rungs with names are in ladder.hpp.
#pragma once

namespace render {

// How the lens between pupil and scene is represented on the device.
enum class LensForm {
  exact,   // the surfaces themselves, each ray traced through both
  mesh,    // two triangle meshes with normals at their vertices, which the paper (section 4) says it avoids
  bezier,  // free-form surfaces as Bezier patches behind a bounding volume hierarchy, the paper's way (section 4)
  field    // chief rays precomputed on a grid over the view and interpolated (Kakimoto et al. 2007, 2010)
};

// Whether the rays of a tile of 8 x 8 pixels may be cubics between 16 of them: where those run so smoothly that none is
// off by more than 1e-4 pixels and 0.005 D, on devices where that pays (lens_forms/tile_cubics.hpp). Everywhere else
// each pixel's ray is traced.
enum class TileCubics {
  never,
  in_pictures,  // not in maps, and not where wavefronts are kept: those are looked at for their figures
  always
};

// Rays at the edges of things, and samples of mode dof, go through the lens in the same form, but for what is
// interpolated between chief rays (field, spacing): there they pass the exact lens. In double precision are chief rays
// and samples.
struct LensAccuracy {
  LensForm form = LensForm::exact;
  int facets = 0;      // mesh: triangles of each surface on the lens's disc, 8 or more
  int field_side = 0;  // field: precomputed rays along each side of the view, 2 or more
  int iterations = 0;  // steps of Newton's method for a surface, up to 8; 0: until they settle
  int spacing = 1;     // exact: pixels between rays through the lens, those between interpolated; 1: every pixel
  TileCubics cubics = TileCubics::in_pictures;  // exact, with a ray a pixel
  bool in_double = false;                       // exact: surfaces and refraction in double precision on the device

  // std::invalid_argument for what no renderer can do.
  void validate() const;
};

enum class BlurKernel {
  disc,     // the uniform ellipse of a round pupil
  gaussian  // of the same second moments, the paper's (section 6.3)
};

struct BlurAccuracy {
  BlurKernel kernel = BlurKernel::disc;
  int taps = 256;  // about the most of a gathered blur; fewer where it has fewer pixels
  int rate = 2;    // pixels between gathered ones where the minor semi-axis is 6 px or more; 1: every pixel
};

struct Foveation {
  double fovea_deg = 0.0;  // full resolution within this angle of the gaze; 0: everywhere
  int rate = 1;            // pixels of the periphery are this many wide
};

struct Accuracy {
  LensAccuracy lens = {};
  BlurAccuracy blur = {};
  double resolution = 1.0;  // pixels traced along each side to pixels shown
  Foveation foveation = {};
};

}  // namespace render
