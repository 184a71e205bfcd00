# The sample terrain.
tks_room(tks_synth
  SOURCES synth.cpp synth_basins.cpp synth_drainage.cpp synth_erosion.cpp synth_grid.cpp synth_ground.cpp synth_kinds.cpp
    synth_layout.cpp synth_map.cpp synth_parcels.cpp synth_relief.cpp synth_rivers.cpp synth_texture.cpp
  USES tks_bitstream)
