#include "forest/train/communicator.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <exception>
#include <string>

#include <mpi.h>

#include "depthmocap/error.h"

namespace depthmocap {
namespace {

constexpr std::size_t kLargestMessage = std::size_t{1} << 30U;  // MPI counts in int

void check(int result, const char* what) {
  if (result == MPI_SUCCESS) return;
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  int length = 0;
  MPI_Error_string(result, text.data(), &length);
  throw Error(std::string(text.data(), static_cast<std::size_t>(length)), what, "see what mpirun says of the ranks");
}

class MpiCommunicator : public Communicator {
 public:
  MpiCommunicator() {
    int provided = 0;
    check(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided), "MPI_Init_thread");
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    check(MPI_Comm_rank(MPI_COMM_WORLD, &rank_), "MPI_Comm_rank");
    check(MPI_Comm_size(MPI_COMM_WORLD, &size_), "MPI_Comm_size");
  }
  // A rank that fails while the others wait for it ends them all.
  ~MpiCommunicator() override {
    if (std::uncaught_exceptions() > 0) MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
    MPI_Finalize();
  }
  MpiCommunicator(const MpiCommunicator&) = delete;
  MpiCommunicator& operator=(const MpiCommunicator&) = delete;

  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int size() const override { return size_; }

  void sum(std::span<std::uint32_t> numbers) override { sumOf(numbers, MPI_UINT32_T); }
  void sum(std::span<std::int64_t> numbers) override { sumOf(numbers, MPI_INT64_T); }

  void sumBefore(std::span<std::uint32_t> numbers) override {
    std::vector<std::uint32_t> before(numbers.size(), 0);
    inPieces(numbers, [&](std::size_t first, int count) {
      check(MPI_Exscan(numbers.data() + first, before.data() + first, count, MPI_UINT32_T, MPI_SUM, MPI_COMM_WORLD),
            "MPI_Exscan");
    });
    if (rank_ == 0) std::fill(before.begin(), before.end(), 0U);  // MPI leaves it undefined
    std::copy(before.begin(), before.end(), numbers.begin());
  }

  std::vector<Bytes> exchange(const std::vector<Bytes>& outgoing) override {
    std::vector<std::uint64_t> out_sizes, in_sizes(outgoing.size());
    for (const Bytes& bytes : outgoing) out_sizes.push_back(bytes.size());
    check(MPI_Alltoall(out_sizes.data(), 1, MPI_UINT64_T, in_sizes.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD),
          "MPI_Alltoall");
    std::vector<Bytes> incoming(outgoing.size());
    std::vector<MPI_Request> requests;
    for (std::size_t r = 0; r < incoming.size(); ++r) {
      incoming[r].resize(in_sizes[r]);
      inPieces(std::span(incoming[r]), [&](std::size_t first, int count) {
        check(MPI_Irecv(incoming[r].data() + first, count, MPI_BYTE, static_cast<int>(r), 0, MPI_COMM_WORLD,
                        &requests.emplace_back()),
              "MPI_Irecv");
      });
      inPieces(std::span(outgoing[r]), [&](std::size_t first, int count) {
        check(MPI_Isend(outgoing[r].data() + first, count, MPI_BYTE, static_cast<int>(r), 0, MPI_COMM_WORLD,
                        &requests.emplace_back()),
              "MPI_Isend");
      });
    }
    check(MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
    return incoming;
  }

 private:
  template <typename Number, typename Body>
  static void inPieces(std::span<Number> numbers, const Body& body) {
    constexpr std::size_t kStep = kLargestMessage / sizeof(Number);
    for (std::size_t first = 0; first < numbers.size(); first += kStep) {
      body(first, static_cast<int>(std::min(kStep, numbers.size() - first)));
    }
  }

  template <typename Number>
  void sumOf(std::span<Number> numbers, MPI_Datatype type) {
    inPieces(numbers, [&](std::size_t first, int count) {
      check(MPI_Allreduce(MPI_IN_PLACE, numbers.data() + first, count, type, MPI_SUM, MPI_COMM_WORLD), "MPI_Allreduce");
    });
  }

  int rank_ = 0;
  int size_ = 1;
};

}  // namespace

void SingleCommunicator::sumBefore(std::span<std::uint32_t> numbers) {
  std::fill(numbers.begin(), numbers.end(), 0U);
}

std::unique_ptr<Communicator> makeCommunicator() {
  // mpirun tells its children so; without it MPI would start services of its own.
  if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) return std::make_unique<SingleCommunicator>();
  return std::make_unique<MpiCommunicator>();
}

}  // namespace depthmocap
