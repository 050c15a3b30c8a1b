// What transfer costs and loses: seconds of baking it for a whole glTF file taken as one mover, and error and bytes a
// vertex of its compression by the number of clusters.
#include <chrono>
#include <cstdio>
#include <ctime>

#include "bake/import/import.h"
#include "bake/transfer/compress.h"

namespace oriel {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The least bytes for 2 %, and the least error for 48 bytes.
Status measure_clusters(const VertexTransfer& transfer, Context& context) {
  std::printf("clusters   bytes for 2 %%   error    error at 48 bytes   seconds\n");
  for (const int clusters : {4, 8, 16, 32}) {
    const auto start = std::chrono::steady_clock::now();
    ORIEL_TRY(const auto small, compress_transfer(transfer, {.clusters = clusters, .max_bytes = 129}, context));
    const double seconds = seconds_since(start);
    ORIEL_TRY(const auto bounded, compress_transfer(transfer, {.clusters = clusters, .components = 23}, context));
    std::printf("%8d %15d %6.2f %% %18.2f %% %10.1f\n", clusters, small.bytes_per_vertex(), 100 * small.error,
                100 * bounded.error, seconds);
  }
  return {};
}

Status run(const char* file) {
  Context context;
  ORIEL_TRY(const ImportedScene imported, import_gltf(file, {}, context));
  const Scene& scene = imported.scene;
  ORIEL_TRY(const Accel accel, Accel::build(scene));
  const TransferOptions options;
  std::atomic<std::uint64_t> rays{0};
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t used = std::clock();
  ORIEL_TRY(const VertexTransfer transfer, bake_transfer(accel, options, {context, &rays}));
  const double seconds = seconds_since(start);
  const double processor = static_cast<double>(std::clock() - used) / CLOCKS_PER_SEC;
  std::printf(
      "%zu vertices, %zu triangles, %d bands, %d bounces, %d channels: %.1f s (%.1f s of all processors), %.1f million "
      "rays, standard error %.2f %%, coarse share %.3f\n",
      scene.positions.size(), scene.triangles.size(), options.bands, options.bounces, transfer.channels, seconds,
      processor, 1e-6 * static_cast<double>(rays), 100 * transfer.standard_error, coarse_share(scene, transfer));
  return measure_clusters(transfer, context);
}

}  // namespace
}  // namespace oriel

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: transfer_bench SCENE.glb\n");
    return 1;
  }
  const oriel::Status status = oriel::run(argv[1]);
  if (!status) std::fprintf(stderr, "transfer_bench: %s\n", status.error().text().c_str());
  return status ? 0 : static_cast<int>(status.error().code);
}
