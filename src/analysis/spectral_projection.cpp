#include "analysis/spectral_projection.h"

#include <Eigen/Dense>
#include <algorithm>
#include <stdexcept>

namespace ifov::analysis {

namespace {

constexpr double kStiffening = 1e-9;

/// Rows of the cube as a matrix, in pieces, so that doubles of a whole image are never held at once.
class Covariance {
 public:
  explicit Covariance(int columns) : sum_(Eigen::MatrixXd::Zero(columns, columns)), block_(columns, kBlock) {}

  template <class Row>
  void add(Row row) {
    for (Eigen::Index c = 0; c < block_.rows(); ++c) block_(c, filled_) = row(static_cast<std::size_t>(c));
    ++count_;
    if (++filled_ == kBlock) flush();
  }

  Eigen::MatrixXd mean() {
    flush();
    Eigen::MatrixXd full = sum_.selfadjointView<Eigen::Lower>();
    return full / static_cast<double>(std::max<std::size_t>(1, count_));
  }

 private:
  static constexpr Eigen::Index kBlock = 256;

  void flush() {
    sum_.selfadjointView<Eigen::Lower>().rankUpdate(block_.leftCols(filled_));
    filled_ = 0;
  }

  Eigen::MatrixXd sum_, block_;
  Eigen::Index filled_ = 0;
  std::size_t count_ = 0;
};

std::vector<double> mean_spectrum(const CubeView& cube) {
  const std::size_t columns = static_cast<std::size_t>(cube.columns);
  std::vector<double> mean(columns, 0.0);
  for (std::size_t p = 0; p < cube.pixels(); ++p)
    for (std::size_t c = 0; c < columns; ++c) mean[c] += double(cube.values[p * columns + c]);
  for (double& m : mean) m /= static_cast<double>(cube.pixels());
  return mean;
}

Eigen::MatrixXd covariance(const CubeView& cube, const std::vector<double>& mean) {
  const std::size_t columns = static_cast<std::size_t>(cube.columns);
  Covariance sum(cube.columns);
  for (std::size_t p = 0; p < cube.pixels(); ++p)
    sum.add([&](std::size_t c) { return double(cube.values[p * columns + c]) - mean[c]; });
  return sum.mean();
}

/// Half the covariance of neighbours' differences.
Eigen::MatrixXd noise_covariance(const CubeView& cube) {
  const std::size_t columns = static_cast<std::size_t>(cube.columns),
                    width = static_cast<std::size_t>(cube.width);
  Covariance sum(cube.columns);
  const auto add = [&](std::size_t p, std::size_t q) {
    sum.add([&](std::size_t c) {
      return double(cube.values[p * columns + c]) - double(cube.values[q * columns + c]);
    });
  };
  for (std::size_t p = 0; p < cube.pixels(); ++p) {
    if (p % width + 1 < width) add(p, p + 1);
    if (p + width < cube.pixels()) add(p, p + width);
  }
  return 0.5 * sum.mean();
}

/// The last `count` of the solver's rising eigenvalues, largest first. Signs are such that each axis's weights
/// have a positive sum: eigenvectors know none.
template <class Solver>
SpectralAxes axes_of(const Solver& solver, std::vector<double> mean, int count) {
  SpectralAxes axes;
  axes.columns = static_cast<int>(mean.size());
  axes.mean = std::move(mean);
  const Eigen::Index size = solver.eigenvalues().size();
  for (Eigen::Index k = 0; k < std::min<Eigen::Index>(count, size); ++k) {
    const auto vector = solver.eigenvectors().col(size - 1 - k);
    const double sign = vector.sum() < 0.0 ? -1.0 : 1.0;
    axes.strength.push_back(solver.eigenvalues()[size - 1 - k]);
    for (Eigen::Index c = 0; c < size; ++c) axes.weights.push_back(sign * vector[c]);
  }
  return axes;
}

SpectralAxes noise_fraction_axes(const Eigen::MatrixXd& image, Eigen::MatrixXd noise,
                                 std::vector<double> mean, int count) {
  const double stiffening =
      kStiffening * std::max(noise.trace(), 1e-12 * image.trace()) / double(noise.rows());
  noise.diagonal().array() += stiffening;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(image, noise);
  return axes_of(solver, std::move(mean), count);
}

}  // namespace

SpectralAxes principal_axes(const CubeView& cube, int count) {
  std::vector<double> mean = mean_spectrum(cube);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance(cube, mean));
  return axes_of(solver, std::move(mean), count);
}

SpectralAxes minimum_noise_axes(const CubeView& cube, int count) {
  std::vector<double> mean = mean_spectrum(cube);
  const Eigen::MatrixXd image = covariance(cube, mean);
  return noise_fraction_axes(image, noise_covariance(cube), std::move(mean), count);
}

SpectralAxes minimum_noise_axes(const CubeView& cube, std::span<const double> noise_variance, int count) {
  if (noise_variance.size() != static_cast<std::size_t>(cube.columns))
    throw std::invalid_argument("a variance of noise for each channel is needed");
  if (std::none_of(noise_variance.begin(), noise_variance.end(), [](double v) { return v > 0.0; }))
    throw std::invalid_argument("no channel has noise");
  std::vector<double> mean = mean_spectrum(cube);
  Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(cube.columns, cube.columns);
  for (Eigen::Index c = 0; c < noise.rows(); ++c) noise(c, c) = noise_variance[static_cast<std::size_t>(c)];
  const Eigen::MatrixXd image = covariance(cube, mean);
  return noise_fraction_axes(image, std::move(noise), std::move(mean), count);
}

std::vector<float> project(const SpectralAxes& axes, const CubeView& cube) {
  const std::size_t columns = static_cast<std::size_t>(cube.columns),
                    count = static_cast<std::size_t>(axes.count());
  std::vector<float> scores(cube.pixels() * count);
  for (std::size_t p = 0; p < cube.pixels(); ++p)
    for (std::size_t k = 0; k < count; ++k) {
      double sum = 0.0;
      for (std::size_t c = 0; c < columns; ++c)
        sum += axes.weights[k * columns + c] * (double(cube.values[p * columns + c]) - axes.mean[c]);
      scores[p * count + k] = static_cast<float>(sum);
    }
  return scores;
}

}  // namespace ifov::analysis
