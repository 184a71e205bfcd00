tks_room(tks_texture_transform
  SOURCES colour.cpp
  USES tks_wavelet)
