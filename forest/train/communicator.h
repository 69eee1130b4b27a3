#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace depthmocap {

// The processes that train one forest together, each with a share of the images. Every rank calls the same functions in
// the same order, from one thread. All sums are of whole numbers, so that nothing depends on the number of ranks.
class Communicator {
 public:
  using Bytes = std::vector<std::byte>;

  virtual ~Communicator() = default;
  [[nodiscard]] virtual int rank() const = 0;  // [0, size())
  [[nodiscard]] virtual int size() const = 0;

  // Every rank's numbers become the sum over all ranks; all spans have the same size.
  virtual void sum(std::span<std::uint32_t> numbers) = 0;
  virtual void sum(std::span<std::int64_t> numbers) = 0;
  // Every rank's numbers become the sum over the ranks before it.
  virtual void sumBefore(std::span<std::uint32_t> numbers) = 0;
  // outgoing[r] goes to rank r; result[r] has come from there. outgoing[rank()] is empty.
  virtual std::vector<Bytes> exchange(const std::vector<Bytes>& outgoing) = 0;
};

// One process by itself.
class SingleCommunicator : public Communicator {
 public:
  [[nodiscard]] int rank() const override { return 0; }
  [[nodiscard]] int size() const override { return 1; }
  void sum(std::span<std::uint32_t>) override {}
  void sum(std::span<std::int64_t>) override {}
  void sumBefore(std::span<std::uint32_t> numbers) override;
  std::vector<Bytes> exchange(const std::vector<Bytes>& outgoing) override { return outgoing; }
};

// The processes that mpirun (OpenMPI) has started; one process by itself where it was not started by mpirun. A process
// makes it once. Throws Error where MPI fails.
std::unique_ptr<Communicator> makeCommunicator();

}  // namespace depthmocap
