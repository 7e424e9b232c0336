"""Poses of a tool."""
import rospy
from geometry_msgs.msg import PoseStamped


def tool_pose(z):
    """Returns the pose of a tool at this height, without a stamp."""
    pose = PoseStamped()
    pose.header.frame_id = 'world'
    pose.pose.position.z = z
    pose.pose.orientation.w = 1.0
    return pose


def publish_tool_pose(test, z, rate):
    """Publishes this pose until the test ends."""
    publisher = rospy.Publisher('/tool_pose', PoseStamped, queue_size=10)
    pose = tool_pose(z)

    def publish(_):
        pose.header.stamp = rospy.Time.now()
        publisher.publish(pose)
    timer = rospy.Timer(rospy.Duration(1.0 / rate), publish)
    test.addCleanup(publisher.unregister)
    test.addCleanup(timer.join)
    test.addCleanup(timer.shutdown)
