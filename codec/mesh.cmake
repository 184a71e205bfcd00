# 4-8 meshes: lattice, closures, RD decimation. Decoders need all of it for their budget meshes.
tks_room(tks_mesh
  SOURCES clamped_triangle.cpp decimation.cpp gains.cpp lattice.cpp lattice_mesh.cpp slope_queue.cpp
  USES tks_bitstream)
