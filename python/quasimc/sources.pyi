from . import Source as Source
from . import directional as directional
from . import lamp as lamp
from . import sky as sky
from . import sky_models as sky_models
from . import source_types as source_types
from . import sun as sun
from . import uniform_sky as uniform_sky

LAMPS: tuple[str, ...]
