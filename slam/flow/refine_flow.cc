#include "slam/flow/refine_flow.h"

#include <opencv2/imgproc.hpp>

namespace aisle::slam {
namespace {

// Weights of what must hold, of which only the shares matter, and the relaxation of its solver.
constexpr float kSmooth = 20, kGrey = 5, kGradient = 10;
constexpr float kRelaxation = 1.6F;
constexpr int kSweeps = 5;
constexpr float kLeastSquare = 1e-6F;    // of what a root is taken, so that its slope is finite
constexpr float kLeastGradient = 0.01F;  // squared, grey levels per pixel

/// A margin of one pixel that is never part of the image.
cv::Mat1f Padded(const cv::Mat1f& image) {
  cv::Mat1f padded;
  cv::copyMakeBorder(image, padded, 1, 1, 1, 1, cv::BORDER_REPLICATE);
  return padded;
}

/// The view where each pixel of the image is seen in it; its border is repeated outside.
cv::Mat1f Warped(const cv::Mat1f& view, const cv::Mat1f& u, const cv::Mat1f& v) {
  cv::Mat1f warped(view.size());
  const int last_column = view.cols - 2, last_line = view.rows - 2;
  const float most_x = static_cast<float>(view.cols - 1),
              most_y = static_cast<float>(view.rows - 1);
  const int step = static_cast<int>(view.step1());
  const float* from = view[0];
  for (int y = 0; y < view.rows; ++y) {
    const float *du = u[y], *dv = v[y], row = static_cast<float>(y);
    float* to = warped[y];
#pragma GCC ivdep
    for (int x = 0; x < view.cols; ++x) {
      float px = static_cast<float>(x) + du[x], py = row + dv[x];
      px = px > 0 ? px : 0;
      py = py > 0 ? py : 0;
      px = px < most_x ? px : most_x;
      py = py < most_y ? py : most_y;
      const int whole_x = static_cast<int>(px), whole_y = static_cast<int>(py);
      const int column = whole_x < last_column ? whole_x : last_column;
      const int line = whole_y < last_line ? whole_y : last_line;
      const float right = px - static_cast<float>(column), lower = py - static_cast<float>(line);
      const int at = line * step + column;
      const float upper_grey = from[at] + right * (from[at + 1] - from[at]);
      const float lower_grey = from[at + step] + right * (from[at + step + 1] - from[at + step]);
      to[x] = upper_grey + lower * (lower_grey - upper_grey);
    }
  }
  return warped;
}

/// Central differences; the border is repeated.
struct Gradient {
  explicit Gradient(const cv::Mat1f& image) : x(image.size()), y(image.size()) {
    const cv::Mat1f padded = Padded(image);
    for (int row = 0; row < image.rows; ++row) {
      const float *above = padded[row] + 1, *here = padded[row + 1] + 1,
                  *below = padded[row + 2] + 1;
      float *gx = x[row], *gy = y[row];
#pragma GCC ivdep
      for (int k = 0; k < image.cols; ++k) {
        gx[k] = (here[k + 1] - here[k - 1]) / 2;
        gy[k] = (below[k] - above[k]) / 2;
      }
    }
  }
  cv::Mat1f x, y;
};

/// What the images say of a change of the flow, to first order around where they were warped.
struct Images {
  Images(const cv::Mat1f& image, const cv::Mat1f& warped)
      : mean((image + warped) / 2), difference(warped - image) {}
  cv::Mat1f mean, difference;
  Gradient of_mean{mean}, of_difference{difference};
  Gradient of_x{of_mean.x}, of_y{of_mean.y};
};

/// The equations of every pixel: (xx xy; xy yy) (u v)' + what links it to its neighbours = (x y)'.
struct Equations {
  explicit Equations(cv::Size size)
      : xx(size), xy(size), yy(size), x(size), y(size), per_u(size), per_v(size) {}
  cv::Mat1f xx, xy, yy, x, y;
  cv::Mat1f per_u, per_v;  // 1 / (xx and yy with the links' strength)
};

struct Row {
  float *xx, *xy, *yy, *x, *y;
};

/// The data terms of a row for the change (u - u0, v - v0) that was found last.
void MeasureRow(const Images& images, int row, const float* u0, const float* v0, const float* u,
                const float* v, const Row& to) {
  const float *ix = images.of_mean.x[row], *iy = images.of_mean.y[row],
              *it = images.difference[row], *ixx = images.of_x.x[row], *ixy = images.of_x.y[row],
              *iyy = images.of_y.y[row], *ixt = images.of_difference.x[row],
              *iyt = images.of_difference.y[row];
  float *xx = to.xx, *xy = to.xy, *yy = to.yy, *bx = to.x, *by = to.y;
  const int columns = images.mean.cols;
#pragma GCC ivdep
  for (int k = 0; k < columns; ++k) {
    const float du = u[k] - u0[k], dv = v[k] - v0[k];
    const float grey = it[k] + ix[k] * du + iy[k] * dv;
    const float grey_norm = 1 / (ix[k] * ix[k] + iy[k] * iy[k] + kLeastGradient);
    const float g = kGrey * grey_norm / std::sqrt(grey * grey * grey_norm + kLeastSquare);
    const float along_x = ixt[k] + ixx[k] * du + ixy[k] * dv;
    const float along_y = iyt[k] + ixy[k] * du + iyy[k] * dv;
    const float x_norm = 1 / (ixx[k] * ixx[k] + ixy[k] * ixy[k] + kLeastGradient);
    const float y_norm = 1 / (ixy[k] * ixy[k] + iyy[k] * iyy[k] + kLeastGradient);
    const float both = kGradient / std::sqrt(along_x * along_x * x_norm +
                                             along_y * along_y * y_norm + kLeastSquare);
    const float hx = both * x_norm, hy = both * y_norm;
    xx[k] = g * ix[k] * ix[k] + hx * ixx[k] * ixx[k] + hy * ixy[k] * ixy[k];
    xy[k] = g * ix[k] * iy[k] + hx * ixx[k] * ixy[k] + hy * ixy[k] * iyy[k];
    yy[k] = g * iy[k] * iy[k] + hx * ixy[k] * ixy[k] + hy * iyy[k] * iyy[k];
    const float cx = g * ix[k] * it[k] + hx * ixx[k] * ixt[k] + hy * ixy[k] * iyt[k];
    const float cy = g * iy[k] * it[k] + hx * ixy[k] * ixt[k] + hy * iyy[k] * iyt[k];
    bx[k] = xx[k] * u0[k] + xy[k] * v0[k] - cx;
    by[k] = xy[k] * u0[k] + yy[k] * v0[k] - cy;
  }
}

/// The flow within margins of a pixel, and how strongly each pixel holds its right and its lower
/// neighbour: 0 at the image's edge.
struct Smoothed {
  Smoothed(const cv::Mat1f& u0, const cv::Mat1f& v0)
      : u(Padded(u0)), v(Padded(v0)), right(u.size(), 0.0F), down(u.size(), 0.0F) {}
  void Hold();
  cv::Mat1f u, v, right, down;
};

void Smoothed::Hold() {
  const int columns = u.cols - 2, rows = u.rows - 2;
  for (int y = 1; y <= rows; ++y) {
    const float *u0 = u[y] + 1, *v0 = v[y] + 1, *u1 = u[y + 1] + 1, *v1 = v[y + 1] + 1;
    const float lower = y < rows ? 1.0F : 0.0F;
    float *to_right = right[y] + 1, *to_down = down[y] + 1;
#pragma GCC ivdep
    for (int x = 0; x < columns; ++x) {
      const float ux = u0[x + 1] - u0[x], vx = v0[x + 1] - v0[x];
      const float uy = lower * (u1[x] - u0[x]), vy = lower * (v1[x] - v0[x]);
      const float hold =
          kSmooth / std::sqrt((ux * ux + vx * vx) + (uy * uy + vy * vy) + kLeastSquare);
      to_right[x] = hold;
      to_down[x] = lower * hold;
    }
    to_right[columns - 1] = 0;
  }
}

/// Successive over-relaxation of every second pixel of a row, those where `mine` is 1: none of them
/// is the other's neighbour, so that all may go at once.
void RelaxRow(const Equations& equations, int row, const float* mine, const Smoothed& flow,
              float* next_u, float* next_v) {
  const float *per_u = equations.per_u[row], *per_v = equations.per_v[row], *xy = equations.xy[row],
              *bx = equations.x[row], *by = equations.y[row];
  const float *u = flow.u[row + 1] + 1, *v = flow.v[row + 1] + 1;
  const float *u_above = flow.u[row] + 1, *v_above = flow.v[row] + 1;
  const float *u_below = flow.u[row + 2] + 1, *v_below = flow.v[row + 2] + 1;
  const float *right = flow.right[row + 1] + 1, *down = flow.down[row + 1] + 1,
              *from_above = flow.down[row] + 1;
  const int columns = equations.xy.cols;
#pragma GCC ivdep
  for (int x = 0; x < columns; ++x) {
    const float u_held = (right[x] * u[x + 1] + right[x - 1] * u[x - 1]) +
                         (down[x] * u_below[x] + from_above[x] * u_above[x]);
    const float v_held = (right[x] * v[x + 1] + right[x - 1] * v[x - 1]) +
                         (down[x] * v_below[x] + from_above[x] * v_above[x]);
    const float relax = kRelaxation * mine[x];
    const float new_u = u[x] + relax * ((bx[x] + u_held - xy[x] * v[x]) * per_u[x] - u[x]);
    next_u[x] = new_u;
    next_v[x] = v[x] + relax * ((by[x] + v_held - xy[x] * new_u) * per_v[x] - v[x]);
  }
}

void InvertDiagonals(const Smoothed& flow, Equations& equations) {
  for (int y = 0; y < equations.xx.rows; ++y) {
    const float *right = flow.right[y + 1] + 1, *down = flow.down[y + 1] + 1,
                *from_above = flow.down[y] + 1;
    const float *xx = equations.xx[y], *yy = equations.yy[y];
    float *per_u = equations.per_u[y], *per_v = equations.per_v[y];
#pragma GCC ivdep
    for (int x = 0; x < equations.xx.cols; ++x) {
      const float held = (right[x] + right[x - 1]) + (down[x] + from_above[x]);
      per_u[x] = 1 / (xx[x] + held);
      per_v[x] = 1 / (yy[x] + held);
    }
  }
}

void Relax(const Equations& equations, Smoothed& flow) {
  std::array<std::vector<float>, 2> colour;
  for (int x = 0; x < equations.xx.cols; ++x) {
    colour[0].push_back(x % 2 == 0 ? 1.0F : 0.0F);
    colour[1].push_back(x % 2 == 0 ? 0.0F : 1.0F);
  }
  cv::Mat1f next_u = flow.u.clone(), next_v = flow.v.clone();
  for (int half = 0; half < 2 * kSweeps; ++half) {
    for (int y = 0; y < equations.xx.rows; ++y) {
      RelaxRow(equations, y, colour[static_cast<std::size_t>((y + half) % 2)].data(), flow,
               next_u[y + 1] + 1, next_v[y + 1] + 1);
    }
    cv::swap(flow.u, next_u);
    cv::swap(flow.v, next_v);
  }
}

}  // namespace

void RefineFlow(const cv::Mat1f& image, const cv::Mat1f& view, int iterations, cv::Mat1f& u,
                cv::Mat1f& v) {
  if (iterations == 0) return;
  const Images images(image, Warped(view, u, v));
  Smoothed flow(u, v);
  Equations equations(image.size());
  for (int k = 0; k < iterations; ++k) {
    for (int y = 0; y < image.rows; ++y) {
      MeasureRow(
          images, y, u[y], v[y], flow.u[y + 1] + 1, flow.v[y + 1] + 1,
          {equations.xx[y], equations.xy[y], equations.yy[y], equations.x[y], equations.y[y]});
    }
    flow.Hold();
    InvertDiagonals(flow, equations);
    Relax(equations, flow);
  }
  const cv::Rect inner({1, 1}, image.size());
  flow.u(inner).copyTo(u);
  flow.v(inner).copyTo(v);
}

}  // namespace aisle::slam
