"""tf2_msgs/TFMessage from its definition: Debian's ROS does not bring its Python module with what the guard needs."""
from geometry_msgs.msg import TransformStamped
from genpy.dynamic import generate_dynamic

_TEXT = '\n'.join(['geometry_msgs/TransformStamped[] transforms', '=' * 80, 'MSG: geometry_msgs/TransformStamped',
                   TransformStamped._full_text])
TFMessage = generate_dynamic('tf2_msgs/TFMessage', _TEXT)['tf2_msgs/TFMessage']
