from .CaribuScene import CaribuScene as CaribuScene
