"""rosbag, whose migration does not work with Python 3.13: there, exec() fills no locals() that are read later."""
import inspect

import rosbag
from rosbag import migration

source = inspect.getsource(migration)
repaired = source.replace('exec(printclassdef)\n        return locals()[name]',
                          'scope = {}\n        exec(printclassdef, globals(), scope)\n        return scope[name]')
exec(compile(repaired, migration.__file__, 'exec'), migration.__dict__)
rosbag.rosbag_main.MessageMigrator = migration.MessageMigrator
rosbag.rosbagmain()
