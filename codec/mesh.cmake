# 4-8 meshes: lattice, closures, RD decimation. Decoders need all of it for their budget meshes.
tks_room(tks_mesh
  SOURCES clamped_triangle.cpp closure.cpp coarse_surface.cpp closure_flow.cpp complete_domains.cpp decimation.cpp deferred_losses.cpp
    fitted_heights.cpp fitted_moments.cpp fitted_solver.cpp gains.cpp general_decimation.cpp lattice.cpp lattice_mesh.cpp
    leaf_order.cpp local_errors.cpp merging_domains.cpp slope_queue.cpp
  USES tks_bitstream)
