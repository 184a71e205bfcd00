tks_room(tks_texture_transform
  SOURCES colour.cpp norms.cpp wavelet.cpp
  USES tks_bitstream)
