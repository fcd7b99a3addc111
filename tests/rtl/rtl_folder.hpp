// SPDX-License-Identifier: Apache-2.0
// Where the RTL finds the entries of its tables: $readmemh takes names from the current folder.
#pragma once

#include <filesystem>

namespace degs::rtl_test {

/// While it lives, the current folder is that of the tables.
class InTableFolder {
public:
    InTableFolder() { std::filesystem::current_path(DEGS_RTL_TABLES); }
    ~InTableFolder() { std::filesystem::current_path(before_); }
    InTableFolder(const InTableFolder&) = delete;
    InTableFolder& operator=(const InTableFolder&) = delete;

private:
    std::filesystem::path before_ = std::filesystem::current_path();
};

} // namespace degs::rtl_test
