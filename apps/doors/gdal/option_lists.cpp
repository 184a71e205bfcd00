// SPDX-License-Identifier: Apache-2.0
// What GDAL shows of the options, and checks names and types by.
#include "apps/doors/gdal/settings.hpp"

namespace tetrakis::gdal {

const char* const kOpenOptions =
    "<OpenOptionList>"
    "<Option name='BYTES' type='string' description='Read no more than so many bytes from the "
    "front of the stream (k, M and G are powers of 1024): a rougher terrain, sooner'/>"
    "<Option name='STRICT' type='boolean' default='NO' description='Refuse streams that end early, "
    "and check the whole syntax'/>"
    "<Option name='NUM_THREADS' type='string' description='Threads of decoding: a number, or "
    "ALL_CPUS' default='1'/>"
    "<Option name='COMPONENT' type='string' description='Show this component of a stream of "
    "several, by its name or number'/>"
    "</OpenOptionList>";

const char* const kCreationOptions =
    "<CreationOptionList>"
    "<Option name='LOSSLESS' type='boolean' description='All pixels come back as they are: the "
    "default without MAX_Z_ERROR, BYTES and PSNR'/>"
    "<Option name='MAX_Z_ERROR' type='float' default='0' description='Largest error of any pixel, "
    "in pixel values, guaranteed; 0 is lossless'/>"
    "<Option name='BYTES' type='string' description='Size of the file: the best that fits (k, M "
    "and G are powers of 1024)'/>"
    "<Option name='PSNR' type='float' description='Quality of heights and texture, in dB'/>"
    "<Option name='TEXTURE' type='string' description='Dataset with an image over the same ground, "
    "of 1 to 4 bands of Byte or UInt16'/>"
    "<Option name='WHITE_LEVEL' type='int' description='Value of a texture of UInt16 that shows as "
    "white; found if not given'/>"
    "<Option name='BLOCKSIZE' type='string' description='Side of the regions that can be read by "
    "themselves: a power of two from 16 to 1048576, or NONE; chosen if not given'/>"
    "<Option name='TILES' type='string' default='AUTO' description='Heights are read, coded and "
    "written tile by tile, in the memory of one: the side of the tiles, a power of two from 16 to "
    "16384, or NONE; AUTO: where they would take more than a quarter of the memory'/>"
    "<Option name='INDEX' type='string-select' description='Write the byte ranges of all packets "
    "into the header; WINDOWS, for lossless files and MAX_Z_ERROR: also lay each region out in one "
    "piece, for windows; regions are of 256, unless BLOCKSIZE is given. Default: WINDOWS for "
    "lossless files in regions, else NO'>"
    "<Value>NO</Value><Value>YES</Value><Value>WINDOWS</Value></Option>"
    "<Option name='DOMAIN' type='string-select' default='AUTO' description='CYLINDER: the last "
    "column lies beside the first one, and no seam is seen between them; AUTO: of geographic grids "
    "of 360 degrees; CUBE: such a grid is resampled on a cube, for BYTES or PSNR'>"
    "<Value>AUTO</Value><Value>PLANE</Value><Value>CYLINDER</Value><Value>CUBE</Value></Option>"
    "<Option name='DEPTH' type='int' description='Of DOMAIN=CUBE, from 1 to 14: the faces have "
    "2^DEPTH x 2^DEPTH squares; chosen if not given'/>"
    "<Option name='FRAMES' type='boolean' default='NO' description='Bands are heights that follow "
    "one another in time, and become the frames of a sequence'/>"
    "<Option name='REFERENCE' type='string' default='NONE' description='Of FRAMES=YES: each group "
    "of frames goes on from what so many bytes of each frame show of the last one before it, and "
    "is "
    "decoded with the groups before it; ALL: all bytes; NONE: each group stands by itself'/>"
    "<Option name='ENTRY' type='int' default='16' description='Beside REFERENCE: at least every so "
    "manyth group stands by itself, from 1 to 64'/>"
    "<Option name='NUM_THREADS' type='string' description='Threads of encoding: a number, or "
    "ALL_CPUS' default='1'/>"
    "</CreationOptionList>";

}  // namespace tetrakis::gdal
