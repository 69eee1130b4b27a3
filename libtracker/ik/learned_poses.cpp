#include "libtracker/ik/learned_poses.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <utility>

#include "depthmocap/error.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/core/byte_reader.h"

// Layout, little-endian: "DMCPOSE1"; u32 length of origin, origin; then in the order of LearnedPoses, a matrix as u32
// rows, u32 columns and its numbers as 16-bit floats, column by column. A Gaussian is weight, mean, basis, deviation
// and residual; the mixture starts with its number of Gaussians, a network with its number of layers (W, b each).
namespace depthmocap {
namespace {

constexpr char kMagic[] = "DMCPOSE1";
constexpr std::uint32_t kMaxOrigin = 4096;
constexpr std::uint32_t kMaxSize = 4096;  // of a matrix, a mixture or a network

class Out {
 public:
  void raw(const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); }
  void count(std::size_t value) {
    const auto stored = static_cast<std::uint32_t>(value);
    raw(&stored, sizeof stored);
  }
  template <typename Derived>
  void matrix(const Eigen::MatrixBase<Derived>& m) {
    count(static_cast<std::size_t>(m.rows()));
    count(static_cast<std::size_t>(m.cols()));
    const Eigen::Matrix<Eigen::half, Eigen::Dynamic, Eigen::Dynamic> stored = m.template cast<Eigen::half>();
    raw(stored.data(), static_cast<std::size_t>(stored.size()) * sizeof(Eigen::half));
  }
  void number(double value) { matrix(Eigen::Matrix<double, 1, 1>(value)); }
  void gaussian(const PoseGaussian& g) {
    number(g.weight);
    matrix(g.mean);
    matrix(g.basis);
    matrix(g.deviation);
    number(g.residual_rad);
  }
  void network(const DenseNetwork& network) {
    count(network.layers.size());
    for (const DenseLayer& layer : network.layers) {
      matrix(layer.W);
      matrix(layer.b);
    }
  }
  void coder(const PoseCoder& coder) {
    network(coder.encoder);
    network(coder.decoder);
  }

  std::string bytes;
};

class In : public ByteReader {
 public:
  explicit In(const std::filesystem::path& path) : ByteReader(path, "the file of learned poses") {}

  Eigen::MatrixXd matrix() {
    const auto rows = static_cast<Eigen::Index>(count(kMaxSize));
    const auto cols = static_cast<Eigen::Index>(count(kMaxSize));
    const std::size_t size = static_cast<std::size_t>(rows * cols) * sizeof(Eigen::half);
    require(size);
    Eigen::Matrix<Eigen::half, Eigen::Dynamic, Eigen::Dynamic> stored(rows, cols);
    raw(stored.data(), size);
    Eigen::MatrixXd m = stored.cast<double>();
    check(m.allFinite());
    return m;
  }
  Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index cols) {
    Eigen::MatrixXd m = matrix();
    check(m.rows() == rows && m.cols() == cols);
    return m;
  }
  double positive() {
    const double value = matrix(1, 1)(0, 0);
    check(value > 0);
    return value;
  }
  PoseGaussian gaussian() {
    PoseGaussian g;
    g.weight = positive();
    g.mean = matrix(kShapeDofCount, 1);
    // Into a matrix of any shape first: one of another shape would be written past the fixed number of rows.
    const Eigen::MatrixXd basis = matrix();
    check(basis.rows() == kShapeDofCount && basis.cols() < kShapeDofCount);
    g.basis = basis;
    g.deviation = matrix(g.basis.cols(), 1);
    check((g.deviation.array() > 0).all());
    g.residual_rad = positive();
    return g;
  }
  DenseNetwork network(Eigen::Index inputs, Eigen::Index outputs) {
    DenseNetwork network;
    const std::uint32_t layers = count(kMaxSize);
    for (std::uint32_t i = 0; i < layers; ++i) {
      DenseLayer layer;
      layer.W = matrix().cast<float>();
      check(layer.W.cols() == inputs && layer.W.rows() > 0);
      inputs = layer.W.rows();
      layer.b = matrix(inputs, 1).cast<float>();
      network.layers.push_back(std::move(layer));
    }
    check(!network.layers.empty() && (outputs < 0 || inputs == outputs));
    return network;
  }
  // code_share: outputs of the encoder for each input of the decoder.
  PoseCoder coder(int code_share) {
    PoseCoder coder;
    coder.encoder = network(kShapeDofCount, -1);
    check(coder.encoder.outputs() % code_share == 0);
    coder.decoder = network(coder.encoder.outputs() / code_share, kShapeDofCount);
    return coder;
  }
};

}  // namespace

void saveLearnedPoses(const LearnedPoses& poses, const std::filesystem::path& path) {
  Out out;
  out.raw(kMagic, 8);
  out.count(poses.origin.size());
  out.raw(poses.origin.data(), poses.origin.size());
  out.gaussian(poses.ppca);
  out.count(poses.mixture.size());
  for (const PoseGaussian& g : poses.mixture) out.gaussian(g);
  out.matrix(poses.scale.mean);
  out.matrix(poses.scale.deviation);
  out.coder(poses.autoencoder);
  out.coder(poses.variational);
  writeFileAtomically(path, out.bytes);
}

LearnedPoses loadLearnedPoses(const std::filesystem::path& path) {
  In in(path);
  char magic[8];
  in.raw(magic, sizeof magic);
  if (std::memcmp(magic, kMagic, sizeof magic) != 0) throw Error("is no file of learned poses", path.string());
  LearnedPoses poses;
  poses.origin.resize(in.count(kMaxOrigin));
  in.raw(poses.origin.data(), poses.origin.size());
  poses.ppca = in.gaussian();
  const std::uint32_t components = in.count(kMaxSize);
  in.check(components > 0);
  for (std::uint32_t i = 0; i < components; ++i) poses.mixture.push_back(in.gaussian());
  poses.scale.mean = in.matrix(kShapeDofCount, 1);
  poses.scale.deviation = in.matrix(kShapeDofCount, 1);
  in.check((poses.scale.deviation.array() > 0).all());
  poses.autoencoder = in.coder(1);
  poses.variational = in.coder(2);
  in.end();
  return poses;
}

}  // namespace depthmocap
